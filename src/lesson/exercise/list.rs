//! The exercises, in the order of the lessons.

/// All exercises with the answers in a module: the holes of `notebooks/exercises`, the solutions of
/// `notebooks/solutions`.
#[doc(hidden)]
#[macro_export]
macro_rules! __exercises {
    ($answers:ident) => {
        $crate::__exercises!($answers,
            "1.1" e01_1_clamp lesson01::clamp "Π(x), the value in [lo, hi] nearest to x";
            "1.2" e01_2_one_row lesson01::one_row "one row with two bounds";
            "1.3" e01_3_two_rows lesson01::two_rows "two rows, by trying the four cases";
            "4.1" e04_1_sweep lesson04::sweep "one sweep of projected Gauss-Seidel";
            "4.2" e04_2_impulse lesson04::impulse "one contact of sequential impulses";
            "4.3" e04_3_omega lesson04::omega "the best ω of over-relaxation";
        )
    };
    ($answers:ident, $($id:literal $file:ident $lesson:ident :: $check:ident $title:literal;)*) => {
        &[$($crate::lesson::exercise::Exercise {
            id: $id,
            title: $title,
            file: concat!("notebooks/exercises/", stringify!($file), ".rs"),
            check: || $crate::lesson::exercise::$lesson::$check($answers::$file::answer),
        }),*]
    };
}
pub use crate::__exercises as exercises;
