//! The exercises, in the order of the lessons.

/// All exercises with the answers in a module: the templates of `notebooks/exercises` or the
/// solutions of `notebooks/solutions`.
#[doc(hidden)]
#[macro_export]
macro_rules! __exercises {
    ($answers:ident) => {
        $crate::__exercises!($answers,
            "1.1" e01_1_hand complementarity::hand "a box, a hand and the ground, step by step";
            "1.2" e01_2_one_row complementarity::one_row "one row with two bounds";
            "1.3" e01_3_two_rows complementarity::two_rows "two rows, by trying the four cases";
            "1.b" e01_b_two_contacts complementarity::two_contacts "find the bug: two contacts, case by case";
            "2.1" e02_1_rod jacobians::rod "the row of a rod, and what bends its path";
            "2.2" e02_2_nail jacobians::nail "the three rows of a nail";
            "2.3" e02_3_two_ends jacobians::two_ends "the row of a rod between two bodies that turn";
            "2.b" e02_b_contact jacobians::contact "find the bug: the row of a contact";
            "3.1" e03_1_column newton::column "a column of balls without a matrix: who carries whom";
            "3.2" e03_2_delassus newton::delassus "A: what an impulse does to every row";
            "3.3" e03_3_two_levels newton::two_levels "a pendulum, as an impulse and as a force";
            "3.b" e03_b_step newton::step "find the bug: one step of two bodies on a line";
            "4.1" e04_1_sweep sweeping::sweep "one sweep of projected Gauss-Seidel";
            "4.2" e04_2_impulse sweeping::impulse "one contact of sequential impulses";
            "4.b" e04_b_projected sweeping::projected "find the bug: sweeps over contacts";
            "5.1" e05_1_extrapolate sweeping::extrapolate "from three sweeps to where they will end";
            "6.1" e06_1_active_set pivoting::active_set "the point of an active set";
            "6.b" e06_b_dantzig_step pivoting::dantzig_step "find the bug: how far a row of Dantzig's gets";
            "7.1" e07_1_murty pivoting::murty "Murty's least-index rule";
            "7.2" e07_2_ratio pivoting::ratio "Lemke's ratio test";
            "8.1" e08_1_scaled evidence::scaled "the scaled residual of a problem with bounds";
            "8.2" e08_2_repair evidence::repair "is there an exact answer near this x, and how near?";
            "8.b" e08_b_stop evidence::stop "find the bug: sweeps that know when to stop";
            "9.1" e09_1_farkas evidence::farkas "is this vector a proof that no solution exists?";
            "10.1" e10_1_tangent drift::tangent "how far a step leaves the circle";
            "10.2" e10_2_bias drift::bias "the bias of a contact: gap, slop, overlap";
            "10.3" e10_3_spring drift::spring "γ and β of a row that is a spring";
            "10.b" e10_b_feedback drift::feedback "find the bug: a pendulum with feedback";
            "11.1" e11_1_nearest friction::nearest "the nearest point of a square, a disc and a diamond";
            "11.2" e11_2_cone friction::cone "the nearest point of the friction cone";
            "11.3" e11_3_uphill friction::uphill "a block kicked up a slope";
            "11.b" e11_b_pressed friction::pressed "find the bug: a block is pushed and pressed";
            "12.1" e12_1_two_balls impacts::two_balls "two balls collide, with restitution";
            "12.b" e12_b_bounce impacts::bounce "find the bug: a ball that bounces";
            "13.1" e13_1_all_answers impacts::all_answers "all answers of one row, with a of either sign";
            "13.2" e13_2_critical_friction impacts::critical_friction "the critical friction of a sliding rod";
            "14.1" e14_1_bodies sparsity::bodies "a sweep without A: a velocity for each body";
            "14.2" e14_2_colors sparsity::colors "colors for rows that may be done at once";
            "14.3" e14_3_pattern sparsity::pattern "the pattern of A, from the bodies alone";
            "14.b" e14_b_assembled sparsity::assembled "find the bug: A, put together body by body";
            "15.1" e15_1_layers stack::layers "what each layer of a stack carries";
            "15.2" e15_2_tower stack::tower "a leaning tower: what its corners carry, or that it falls";
            "15.3" e15_3_sweeps stack::sweeps "how many sweeps a mass ratio costs";
            "15.b" e15_b_kept stack::kept "find the bug: a column that keeps its impulses";
            "17.1" e17_1_skier own_constraint::skier "a skier: the force of the snow, and where she takes off";
            "17.2" e17_2_tested own_constraint::tested "a test that finds the wrong entry of a row";
            "17.b" e17_b_bead own_constraint::bead "find the bug: a bead with friction on a wire";
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
