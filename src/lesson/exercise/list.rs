//! The exercises, in the order of the lessons.

/// All exercises with the answers in a module: the holes of `notebooks/exercises`, the solutions of
/// `notebooks/solutions`.
#[doc(hidden)]
#[macro_export]
macro_rules! __exercises {
    ($answers:ident) => {
        $crate::__exercises!($answers,
            "1.1" e01_1_hand lesson01::hand "a box, a hand and the ground, step by step";
            "1.2" e01_2_one_row lesson01::one_row "one row with two bounds";
            "1.3" e01_3_two_rows lesson01::two_rows "two rows, by trying the four cases";
            "1.b" e01_b_two_contacts lesson01::two_contacts "find the bug: two contacts, case by case";
            "2.1" e02_1_rod lesson02::rod "the row of a rod, and what bends its path";
            "2.2" e02_2_nail lesson02::nail "the three rows of a nail";
            "2.3" e02_3_two_ends lesson02::two_ends "the row of a rod between two bodies that turn";
            "2.b" e02_b_contact lesson02::contact "find the bug: the row of a contact";
            "3.1" e03_1_column lesson03::column "a column of balls without a matrix: who carries whom";
            "3.2" e03_2_delassus lesson03::delassus "A: what an impulse does to every row";
            "3.3" e03_3_two_levels lesson03::two_levels "a pendulum, as an impulse and as a force";
            "3.b" e03_b_step lesson03::step "find the bug: one step of two bodies on a line";
            "4.1" e04_1_sweep lesson04::sweep "one sweep of projected Gauss-Seidel";
            "4.2" e04_2_impulse lesson04::impulse "one contact of sequential impulses";
            "4.3" e04_3_extrapolate lesson04::extrapolate "from three sweeps to where they will end";
            "4.b" e04_b_projected lesson04::projected "find the bug: sweeps over contacts";
            "5.1" e05_1_active_set lesson05::active_set "the point of an active set";
            "5.2" e05_2_murty lesson05::murty "Murty's least-index rule";
            "5.3" e05_3_ratio lesson05::ratio "Lemke's ratio test";
            "5.b" e05_b_dantzig_step lesson05::dantzig_step "find the bug: how far a row of Dantzig's gets";
            "6.1" e06_1_scaled lesson06::scaled "the scaled residual of a problem with bounds";
            "6.2" e06_2_repair lesson06::repair "is there an exact answer near this x, and how near?";
            "6.3" e06_3_farkas lesson06::farkas "is this vector a proof that no solution exists?";
            "6.b" e06_b_stop lesson06::stop "find the bug: sweeps that know when to stop";
            "7.1" e07_1_tangent lesson07::tangent "how far a step leaves the circle";
            "7.2" e07_2_bias lesson07::bias "the bias of a contact: gap, slop, overlap";
            "7.3" e07_3_spring lesson07::spring "γ and β of a row that is a spring";
            "7.b" e07_b_feedback lesson07::feedback "find the bug: a pendulum with feedback";
            "8.1" e08_1_nearest lesson08::nearest "the nearest point of a square, a disc and a diamond";
            "8.2" e08_2_cone lesson08::cone "the nearest point of the friction cone";
            "8.3" e08_3_uphill lesson08::uphill "a block kicked up a slope";
            "8.b" e08_b_pressed lesson08::pressed "find the bug: a block is pushed and pressed";
            "9.1" e09_1_two_balls lesson09::two_balls "two balls collide, with restitution";
            "9.2" e09_2_all_answers lesson09::all_answers "all answers of one row, with a of either sign";
            "9.3" e09_3_critical_friction lesson09::critical_friction "the critical friction of a sliding rod";
            "9.b" e09_b_bounce lesson09::bounce "find the bug: a ball that bounces";
            "10.1" e10_1_bodies lesson10::bodies "a sweep without A: a velocity for each body";
            "10.2" e10_2_colours lesson10::colours "colours for rows that may be done at once";
            "10.3" e10_3_pattern lesson10::pattern "the pattern of A, from the bodies alone";
            "10.b" e10_b_assembled lesson10::assembled "find the bug: A, put together body by body";
            "11.1" e11_1_layers lesson11::layers "what each layer of a stack carries";
            "11.2" e11_2_tower lesson11::tower "a leaning tower: what its corners carry, or that it falls";
            "11.3" e11_3_sweeps lesson11::sweeps "how many sweeps a mass ratio costs";
            "11.b" e11_b_kept lesson11::kept "find the bug: a column that keeps its impulses";
            "12.1" e12_1_skier lesson12::skier "a skier: the force of the snow, and where she takes off";
            "12.2" e12_2_tested lesson12::tested "a test that finds the wrong entry of a row";
            "12.b" e12_b_bead lesson12::bead "find the bug: a bead that rubs on a wire";
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
