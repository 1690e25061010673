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
            "4.1" e04_1_sweep lesson04::sweep "one sweep of projected Gauss-Seidel";
            "4.2" e04_2_impulse lesson04::impulse "one contact of sequential impulses";
            "4.3" e04_3_omega lesson04::omega "the best ω of over-relaxation";
            "5.1" e05_1_active_set lesson05::active_set "the point of an active set";
            "5.2" e05_2_murty lesson05::murty "Murty's least-index rule";
            "5.3" e05_3_ratio lesson05::ratio "Lemke's ratio test";
            "6.1" e06_1_residual lesson06::residual "the natural residual of a row with two bounds";
            "6.2" e06_2_gap lesson06::gap "the duality gap";
            "6.3" e06_3_farkas lesson06::farkas "is this vector a proof that no solution exists?";
            "7.1" e07_1_tangent lesson07::tangent "how far a step leaves the circle";
            "7.2" e07_2_bias lesson07::bias "the bias of a contact: gap, slop, overlap";
            "7.3" e07_3_spring lesson07::spring "γ and β of a row that is a spring";
            "8.1" e08_1_friction_row lesson08::friction_row "one friction row of the coupled box in a sweep";
            "8.2" e08_2_cone lesson08::cone "the nearest point of the friction cone";
            "8.3" e08_3_uphill lesson08::uphill "a block kicked up a slope";
            "9.1" e09_1_two_balls lesson09::two_balls "two balls collide, with restitution";
            "9.2" e09_2_all_answers lesson09::all_answers "all answers of one row, with a of either sign";
            "9.3" e09_3_critical_friction lesson09::critical_friction "the critical friction of a sliding rod";
            "10.1" e10_1_place lesson10::place "where an entry lies in a dense matrix";
            "10.2" e10_2_compressed_rows lesson10::compressed_rows "the product of compressed rows with a vector";
            "10.3" e10_3_pattern lesson10::pattern "the pattern of A, from the bodies alone";
            "11.1" e11_1_layers lesson11::layers "what each layer of a stack carries";
            "11.2" e11_2_warm_start lesson11::warm_start "old impulses find their contacts by name";
            "11.3" e11_3_sweeps lesson11::sweeps "how many sweeps a mass ratio costs";
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
