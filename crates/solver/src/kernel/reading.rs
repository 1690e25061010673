//! One pass over memory, in three variants: the reference time for a sweep that reads A.

use super::lanes::{Lanes, Width, Work, sum};

/// Number of independent sums.
const TOGETHER: usize = 4;
/// Size of a cache line in bytes, eight numbers.
const LINE: usize = 64;
/// Prefetch distance in cache lines.
const AHEAD: usize = 16;

/// A way to read memory once. Which one is fastest depends on where the data is cached; the
/// shortest time of all is the reference for a sweep by rows, which reads the same data.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reading {
    /// From the first number to the last.
    InOrder,
    /// The same, prefetching each cache line 1 KiB ahead, for data in an outer cache level.
    AskingAhead,
    /// Four quarters in parallel: hardware prefetches four short streams better than a long one.
    AtFourPlaces,
}

impl Reading {
    /// All variants.
    pub const ALL: [Reading; 3] = [Reading::InOrder, Reading::AskingAhead, Reading::AtFourPlaces];
}

/// The sum of all numbers, in an order that depends on the variant: one pass over memory, as the
/// reference for timing sweeps. Loads are aligned, and four sums are independent, so that the time
/// is limited by memory only.
pub fn read(numbers: &[f64], reading: Reading, width: Width) -> f64 {
    let (unaligned, numbers) = numbers.split_at(to_alignment(numbers));
    unaligned.iter().sum::<f64>() + width.run(Read { numbers, reading })
}

/// The number of elements before the first cache line boundary.
fn to_alignment(numbers: &[f64]) -> usize {
    numbers.as_ptr().align_offset(LINE).min(numbers.len())
}

struct Read<'a> {
    numbers: &'a [f64],
    reading: Reading,
}

impl Work for Read<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<V: Lanes>(self) -> f64 {
        let (blocks, rest) = self.numbers.as_chunks::<8>();
        let rest = rest.iter().sum::<f64>();
        match self.reading {
            Reading::InOrder => rest + total::<V>(blocks, &[]),
            Reading::AskingAhead => {
                rest + total::<V>(blocks, blocks.get(AHEAD..).unwrap_or_default())
            }
            Reading::AtFourPlaces => rest + total_of_quarters::<V>(blocks),
        }
    }
}

/// The sum of all blocks; `ahead` are the blocks to prefetch meanwhile.
#[inline(always)]
fn total<V: Lanes>(blocks: &[[f64; 8]], ahead: &[[f64; 8]]) -> f64 {
    let (fours, rest) = blocks.as_chunks::<TOGETHER>();
    let (asked, _) = ahead.as_chunks::<TOGETHER>();
    let mut lanes = [V::splat(0.0); TOGETHER];
    let (first, last) = fours.split_at(asked.len().min(fours.len()));
    for (four, asked) in first.iter().zip(asked) {
        for k in 0..TOGETHER {
            V::ask_for(&asked[k]);
            lanes[k] = lanes[k] + V::load(&four[k]);
        }
    }
    for four in last {
        for k in 0..TOGETHER {
            lanes[k] = lanes[k] + V::load(&four[k]);
        }
    }
    for block in rest {
        lanes[0] = lanes[0] + V::load(block);
    }
    let [a, b, c, d] = lanes;
    sum(((a + b) + (c + d)).to_array())
}

/// The same, alternating between the four quarters.
#[inline(always)]
fn total_of_quarters<V: Lanes>(blocks: &[[f64; 8]]) -> f64 {
    let quarter = blocks.len() / TOGETHER;
    let (whole, rest) = blocks.split_at(TOGETHER * quarter);
    let mut places = [whole; TOGETHER];
    for k in 0..TOGETHER {
        places[k] = &whole[k * quarter..][..quarter];
    }
    let mut lanes = [V::splat(0.0); TOGETHER];
    for at in 0..quarter {
        for k in 0..TOGETHER {
            lanes[k] = lanes[k] + V::load(&places[k][at]);
        }
    }
    for block in rest {
        lanes[0] = lanes[0] + V::load(block);
    }
    let [a, b, c, d] = lanes;
    sum(((a + b) + (c + d)).to_array())
}
