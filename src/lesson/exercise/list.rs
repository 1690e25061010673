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
            "8.1" e08_1_friction_row lesson08::friction_row "one friction row of the coupled box in a sweep";
            "8.2" e08_2_cone lesson08::cone "the nearest point of the friction cone";
            "8.3" e08_3_uphill lesson08::uphill "a block kicked up a slope";
            "9.1" e09_1_two_balls lesson09::two_balls "two balls collide, with restitution";
            "9.2" e09_2_all_answers lesson09::all_answers "all answers of one row, with a of either sign";
            "9.3" e09_3_critical_friction lesson09::critical_friction "the critical friction of a sliding rod";
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
