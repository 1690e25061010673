//! Vectors of eight numbers: the only file with `unsafe`.
//!
//! A kernel is written once, for [`Lanes`]: eight `f64` with elementwise operations. [`Width::run`]
//! compiles it for each instruction set and selects one at run time, because the compiler's default
//! target has only SSE2. All variants do the same IEEE operations in the same order in each lane,
//! without fused multiply-add, so the results are bitwise identical on every processor.
//!
//! # Why this is sound
//! - AVX instructions are reached only through [`Avx2`] and [`Avx512`]. Both types are private to
//!   this file and used only by `with_avx2` and `with_avx512`, which are called only after checking
//!   that the processor supports the instructions.
//! - Loads and stores go through `&[f64; 8]`, by instructions that need no alignment.
#![allow(unsafe_code)]

use std::ops::{Add, Mul, Sub};

/// Eight numbers with elementwise operations.
pub(crate) trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    /// Whether four sums at a time fit into the registers.
    const WIDE: bool;
    fn load(from: &[f64; 8]) -> Self;
    fn store(self, to: &mut [f64; 8]);
    /// The larger of both, or `other` if neither is larger.
    fn max(self, other: Self) -> Self;
    /// The smaller of both, or `other` if neither is smaller.
    fn min(self, other: Self) -> Self;
    fn abs(self) -> Self;
    /// 0 in lanes whose absolute value is at most `size`.
    fn zero_within(self, size: Self) -> Self;
    /// Whether any lane is at most that of the other.
    fn any_at_most(self, other: Self) -> bool;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self::load(&[value; 8])
    }

    #[inline(always)]
    fn to_array(self) -> [f64; 8] {
        let mut array = [0.0; 8];
        self.store(&mut array);
        array
    }
}

/// Prefetches numbers that will be read soon.
#[inline(always)]
pub(super) fn prefetch(numbers: &[f64; 8]) {
    #[cfg(not(target_arch = "x86_64"))]
    let _ = numbers;
    #[cfg(target_arch = "x86_64")]
    // SAFETY: every x86-64 has the instruction, and a prefetch has no effect visible to the
    // program.
    unsafe {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        _mm_prefetch::<_MM_HINT_T0>(numbers.as_ptr().cast());
    }
}

/// The sum of the eight lanes, in the order of [`dot`](lcplab_lcp::dot).
#[inline(always)]
pub(super) fn sum([a, b, c, d, e, f, g, h]: [f64; 8]) -> f64 {
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}

/// A computation on lanes of any kind. `run` and all functions it calls with lanes must be
/// `#[inline(always)]`; otherwise they are compiled without the instructions.
pub(crate) trait Work {
    type Output;
    fn run<V: Lanes>(self) -> Self::Output;
}

/// The instruction set of a kernel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Width {
    /// Plain arrays, as the compiler vectorizes them: 128 bits at a time on x86-64.
    Portable,
    /// 256 bits at a time.
    Avx2,
    /// 512 bits at a time.
    Avx512,
}

impl Width {
    /// The instruction sets that this processor has.
    pub fn available() -> impl Iterator<Item = Width> {
        [Width::Portable, Width::Avx2, Width::Avx512].into_iter().filter(|width| width.is_here())
    }

    /// The widest instruction set that this processor has.
    pub fn widest() -> Width {
        Width::available().last().unwrap_or(Width::Portable)
    }

    #[cfg(target_arch = "x86_64")]
    fn is_here(self) -> bool {
        match self {
            Width::Portable => true,
            Width::Avx2 => is_x86_feature_detected!("avx2"),
            Width::Avx512 => is_x86_feature_detected!("avx512f"),
        }
    }

    #[cfg(not(target_arch = "x86_64"))]
    fn is_here(self) -> bool {
        self == Width::Portable
    }

    /// Runs the computation with these instructions, or portably if the processor lacks them.
    pub(crate) fn run<W: Work>(self, work: W) -> W::Output {
        #[cfg(target_arch = "x86_64")]
        if self.is_here() {
            // SAFETY: support by the processor has just been checked.
            match self {
                Width::Portable => {}
                Width::Avx2 => return unsafe { x86::with_avx2(work) },
                Width::Avx512 => return unsafe { x86::with_avx512(work) },
            }
        }
        work.run::<Portable>()
    }
}

/// An array.
#[derive(Clone, Copy)]
struct Portable([f64; 8]);

impl Portable {
    #[inline(always)]
    fn zip(mut self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        for k in 0..8 {
            self.0[k] = f(self.0[k], other.0[k]);
        }
        self
    }
}

impl Lanes for Portable {
    const WIDE: bool = false;

    #[inline(always)]
    fn load(from: &[f64; 8]) -> Self {
        Portable(*from)
    }

    #[inline(always)]
    fn store(self, to: &mut [f64; 8]) {
        *to = self.0;
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Portable(self.0.map(f64::abs))
    }

    #[inline(always)]
    fn zero_within(self, size: Self) -> Self {
        self.zip(size, |a, size| if a.abs() <= size { 0.0 } else { a })
    }

    #[inline(always)]
    fn any_at_most(self, other: Self) -> bool {
        (0..8).any(|k| self.0[k] <= other.0[k])
    }
}

macro_rules! operators {
    ($lanes:ty, $($operator:ident $name:ident $body:expr),*) => {
        $(impl $operator for $lanes {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                $body(self, other)
            }
        })*
    };
}

operators!(Portable,
    Add add |a: Portable, b| a.zip(b, |a, b| a + b),
    Sub sub |a: Portable, b| a.zip(b, |a, b| a - b),
    Mul mul |a: Portable, b| a.zip(b, |a, b| a * b));

#[cfg(target_arch = "x86_64")]
mod x86 {
    use std::arch::x86_64::*;
    use std::ops::{Add, Mul, Sub};

    use super::{Lanes, Work};

    #[target_feature(enable = "avx2")]
    pub(super) fn with_avx2<W: Work>(work: W) -> W::Output {
        work.run::<Avx2>()
    }

    #[target_feature(enable = "avx512f")]
    pub(super) fn with_avx512<W: Work>(work: W) -> W::Output {
        work.run::<Avx512>()
    }

    /// Two registers of four.
    #[derive(Clone, Copy)]
    struct Avx2(__m256d, __m256d);

    /// One register of eight.
    #[derive(Clone, Copy)]
    struct Avx512(__m512d);

    // SAFETY, for everything below: see the module documentation.

    macro_rules! by_halves {
        ($intrinsic:expr) => {
            |a: Avx2, b: Avx2| unsafe { Avx2($intrinsic(a.0, b.0), $intrinsic(a.1, b.1)) }
        };
    }

    macro_rules! at_once {
        ($intrinsic:ident) => {
            |a: Avx512, b: Avx512| unsafe { Avx512($intrinsic(a.0, b.0)) }
        };
    }

    operators!(Avx2, Add add by_halves!(_mm256_add_pd), Sub sub by_halves!(_mm256_sub_pd),
        Mul mul by_halves!(_mm256_mul_pd));
    operators!(Avx512, Add add at_once!(_mm512_add_pd), Sub sub at_once!(_mm512_sub_pd),
        Mul mul at_once!(_mm512_mul_pd));

    impl Lanes for Avx2 {
        const WIDE: bool = true;

        #[inline(always)]
        fn load(from: &[f64; 8]) -> Self {
            let (low, high) = from.split_at(4);
            unsafe { Avx2(_mm256_loadu_pd(low.as_ptr()), _mm256_loadu_pd(high.as_ptr())) }
        }

        #[inline(always)]
        fn store(self, to: &mut [f64; 8]) {
            let (low, high) = to.split_at_mut(4);
            unsafe {
                _mm256_storeu_pd(low.as_mut_ptr(), self.0);
                _mm256_storeu_pd(high.as_mut_ptr(), self.1);
            }
        }

        #[inline(always)]
        fn max(self, other: Self) -> Self {
            by_halves!(_mm256_max_pd)(self, other)
        }

        #[inline(always)]
        fn min(self, other: Self) -> Self {
            by_halves!(_mm256_min_pd)(self, other)
        }

        #[inline(always)]
        fn abs(self) -> Self {
            by_halves!(_mm256_andnot_pd)(Self::splat(-0.0), self)
        }

        #[inline(always)]
        fn zero_within(self, size: Self) -> Self {
            let is_larger = by_halves!(_mm256_cmp_pd::<_CMP_NLE_UQ>)(self.abs(), size);
            by_halves!(_mm256_and_pd)(self, is_larger)
        }

        #[inline(always)]
        fn any_at_most(self, other: Self) -> bool {
            let at_most = by_halves!(_mm256_cmp_pd::<_CMP_LE_OQ>)(self, other);
            unsafe { _mm256_movemask_pd(_mm256_or_pd(at_most.0, at_most.1)) != 0 }
        }
    }

    impl Lanes for Avx512 {
        const WIDE: bool = true;

        #[inline(always)]
        fn load(from: &[f64; 8]) -> Self {
            unsafe { Avx512(_mm512_loadu_pd(from.as_ptr())) }
        }

        #[inline(always)]
        fn store(self, to: &mut [f64; 8]) {
            unsafe { _mm512_storeu_pd(to.as_mut_ptr(), self.0) }
        }

        #[inline(always)]
        fn max(self, other: Self) -> Self {
            at_once!(_mm512_max_pd)(self, other)
        }

        #[inline(always)]
        fn min(self, other: Self) -> Self {
            at_once!(_mm512_min_pd)(self, other)
        }

        #[inline(always)]
        fn abs(self) -> Self {
            unsafe { Avx512(_mm512_abs_pd(self.0)) }
        }

        #[inline(always)]
        fn zero_within(self, size: Self) -> Self {
            unsafe {
                let is_larger = _mm512_cmp_pd_mask::<_CMP_NLE_UQ>(self.abs().0, size.0);
                Avx512(_mm512_maskz_mov_pd(is_larger, self.0))
            }
        }

        #[inline(always)]
        fn any_at_most(self, other: Self) -> bool {
            unsafe { _mm512_cmp_pd_mask::<_CMP_LE_OQ>(self.0, other.0) != 0 }
        }
    }
}
