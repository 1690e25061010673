//! The descriptions of solvers, and the settings that they reject.

use lcplab_lcp::Matrix;
use lcplab_lcp::memory::Memory;
use lcplab_solver::{
    Choice, Class, Damping, MatrixClass, Options, Registry, Settings, Status, default_for,
};

use lcplab_testing::contacts;

#[test]
fn a_class_is_its_matrix_and_what_it_excludes() {
    let sweeps = Class::of(MatrixClass::P).with_positive_diagonal();
    assert_eq!(sweeps.to_string(), "P-matrix, positive diagonal");
    let narrow = Class { bounds: false, free_rows: false, coupling: false, ..sweeps };
    let excluded = "equations only, no free rows, no coupled rows";
    assert_eq!(narrow.to_string(), format!("P-matrix, positive diagonal, {excluded}"));
    assert_eq!(
        Registry::standard().entry("code6").unwrap().class.to_string(),
        "symmetric positive semidefinite, positive diagonal, equations only, no coupled rows"
    );
}

#[test]
fn unsymmetric_problems_go_to_lemke() {
    assert_eq!(default_for(&contacts(&[&[2.0, 1.0], &[1.0, 2.0]], &[0.0; 2])), "dantzig");
    assert_eq!(default_for(&contacts(&[&[2.0, 1.0], &[0.0, 2.0]], &[0.0; 2])), "lemke");
    assert!(Matrix::sparse(0, &[]).is_empty() && contacts(&[], &[]).is_empty());
    assert!(!contacts(&[&[1.0]], &[0.0]).is_empty());
}

#[test]
fn settings_that_make_no_sense_are_listed() {
    assert_eq!(
        [Choice::Omega, Choice::Order, Choice::Damping].map(Choice::name),
        ["omega", "order", "damping"]
    );
    assert!(Options::default().validate().is_ok());
    let settings = Settings::default().with_tolerance(-1.0).with_check_every(0);
    assert_eq!(
        settings.validate().unwrap_err().to_string(),
        "settings: 2 defects\n  tolerance: must be at least 0, is -1\n  check_every: must be at least 1, is 0"
    );
    for tolerance in [f64::NAN, f64::INFINITY] {
        assert!(Settings::default().with_tolerance(tolerance).validate().is_err());
    }
    let options = Options::default().with_omega(2.0).with_damping(Damping::Factor(0.0));
    assert_eq!(
        options.validate().unwrap_err().to_string(),
        "settings: 2 defects\n  omega: must lie between 0 and 2, is 2\n  damping: must lie between 0 and 2, is 0"
    );
    let edge = Options::default().with_omega(1.999).with_damping(Damping::Factor(1.999));
    assert!(edge.validate().is_ok());
    let damped = Options::default().with_damping(Damping::Factor(2.0));
    assert!(damped.validate().is_err());
    assert!(Options::default().with_settings(settings).validate().is_err());
}

#[test]
fn what_needs_more_memory_than_there_may_be_is_refused() {
    let limit = Memory::bytes(1000);
    let settings = Settings::default().with_memory(limit);
    assert_eq!(settings.refusal(Memory::bytes(1000)), None);
    let needs = Memory::bytes(1001);
    assert_eq!(settings.refusal(needs), Some(Status::TooLarge { needs, limit }));
}
