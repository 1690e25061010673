//! One pass over memory, in three ways: what a sweep that reads A is held against.

use super::lanes::{Lanes, Width, Work, sum};

/// Sums that run side by side.
const TOGETHER: usize = 4;
/// Bytes of a line of the cache, which are eight numbers.
const LINE: usize = 64;
/// Lines between asking for memory and using it.
const AHEAD: usize = 16;

/// A way to read memory once. Which of them is the fastest depends on where the memory is cached:
/// the least of all is what a sweep by rows, which reads no less, is held against.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reading {
    /// From the first number to the last.
    InOrder,
    /// The same, asking for each line of the cache 1 KiB ahead of its turn: the next level answers
    /// late.
    AskingAhead,
    /// A quarter each at four places at once: four short ways are foreseen better than a long one.
    AtFourPlaces,
}

impl Reading {
    /// All of them.
    pub const ALL: [Reading; 3] = [Reading::InOrder, Reading::AskingAhead, Reading::AtFourPlaces];
}

/// The sum of all numbers, in an order of the reading's own: one pass over memory, beside which
/// sweeps are timed. Loads are aligned, and four sums run side by side, so that nothing but memory
/// is waited for.
pub fn read(numbers: &[f64], reading: Reading, width: Width) -> f64 {
    let (unaligned, numbers) = numbers.split_at(to_alignment(numbers));
    unaligned.iter().sum::<f64>() + width.run(Read { numbers, reading })
}

/// How many numbers stand before the first that begins a line of the cache.
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

/// The sum of all blocks; `ahead` are blocks to ask for meanwhile, as many as there are.
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

/// The same, a block of each quarter in turns.
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
