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
            "2.1" e02_1_rod lesson02::rod "the row of a rod, and what bends its path";
            "2.2" e02_2_nail lesson02::nail "the three rows of a nail";
            "2.3" e02_3_freedoms lesson02::freedoms "the degrees of freedom that rows leave";
            "3.1" e03_1_offset lesson03::offset "b: where a row would move without an impulse";
            "3.2" e03_2_delassus lesson03::delassus "A: what an impulse does to every row";
            "3.3" e03_3_two_levels lesson03::two_levels "a pendulum, as an impulse and as a force";
            "7.1" e07_1_tangent lesson07::tangent "how far a step leaves the circle";
            "7.2" e07_2_bias lesson07::bias "the bias of a contact: gap, slop, overlap";
            "7.3" e07_3_spring lesson07::spring "γ and β of a row that is a spring";
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
