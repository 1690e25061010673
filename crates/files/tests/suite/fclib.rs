use hdf5_writer::{DatasetBuilder, FilterDescription, Hdf5Builder, WriteOptions};
use lcplab_files as files;
use lcplab_lcp::file::Problem;
use lcplab_lcp::friction::{Contact, Model};
use lcplab_lcp::memory::Memory;
use proptest::prelude::*;

use super::{again, assert_same, frictions, message, refusal, rows, sample};
use lcplab_testing::{INF, assert_proved, cases};

#[test]
fn a_local_problem_is_read_with_its_unsymmetric_w() {
    let problem = files::read(&sample("fclib_local.hdf5"), None).unwrap();
    let a = rows(problem.lcp.matrix());
    assert_eq!(a[0], [2.0, 0.0, 0.0, 1.0, 0.125, 0.0, 0.0]);
    assert_eq!(a[4], [0.25, 0.0, 0.0, 0.0, 6.0, 0.0, 0.0]);
    assert_eq!(a[6], [0.0, -0.5, 0.0, 0.0, 0.0, 0.0, 1.5]);
    assert_eq!(a[1][6], -0.5);
    assert_eq!(problem.lcp.b(), [-1.0, 2.0, 0.0, -3.0, 0.0, 1.0, 4.0]);
    assert_eq!(problem.lcp.lo(), [0.0, -INF, -INF, 0.0, -INF, -INF, -INF]);
    let contacts = problem.friction().unwrap().unwrap().contacts().to_vec();
    let expected = [([0, 1, 2], 0.5), ([3, 4, 5], 0.25)];
    assert_eq!(contacts, expected.map(|(rows, mu)| Contact { rows, mu }));
    assert_eq!((problem.model, problem.name.as_str()), (Some(Model::CoulombCone), "two contacts"));
}

/// The same motion as that of the dump in the tests of Chrono's format, without compliance and with
/// the equation behind the contact.
#[test]
fn a_global_problem_becomes_the_problem_in_impulses() {
    let problem = files::read(&sample("fclib_global.hdf5"), None).unwrap();
    let expected = [
        [1.0, 0.0, 0.0, -1.0],
        [0.0, 0.5, 0.0, 0.25],
        [0.0, 0.0, 0.25, 0.0],
        [-1.0, 0.25, 0.0, 1.25],
    ];
    assert_eq!(rows(problem.lcp.matrix()), expected);
    assert_eq!(problem.lcp.b(), [-1.5, 3.0, 0.0, 4.0]);
}

#[test]
fn what_is_no_hdf5_is_refused() {
    assert!(message("fclib", "\u{89}HDF, but nothing else").starts_with("p: "));
}

/// A file of contacts without friction whose zeros are packed a thousandfold, with so many of them
/// in each array of W, and rows that `columns` says.
fn packed(count: usize, columns: i32) -> Vec<u8> {
    let deflate = FilterDescription { id: 1, name: None, client_data: vec![9] };
    let mut file = Hdf5Builder::new();
    let one = |name: &str, value: i32| DatasetBuilder::typed_data(name, vec![1], &[value]).unwrap();
    for (name, value) in [("spacedim", 3), ("W/m", columns), ("W/n", columns), ("W/nz", -1)] {
        file = file.dataset(one(&format!("fclib_local/{name}"), value));
    }
    let (floats, integers) = (vec![0.0; count], vec![0i32; count]);
    let shape = || vec![count as u64];
    for (name, dataset) in [
        ("x", DatasetBuilder::typed_data("fclib_local/W/x", shape(), &floats)),
        ("i", DatasetBuilder::typed_data("fclib_local/W/i", shape(), &integers)),
        ("p", DatasetBuilder::typed_data("fclib_local/W/p", shape(), &integers)),
    ] {
        let dataset = dataset.unwrap_or_else(|cause| panic!("{name}: {cause}"));
        file = file.dataset(dataset.chunked(shape()).filter(deflate.clone()));
    }
    file.into_plan().unwrap().encode(WriteOptions::default()).unwrap()
}

#[test]
fn a_small_file_of_large_arrays_is_refused_before_they_are_unpacked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.hdf5");
    let read = |count: usize, columns: i32, most| {
        std::fs::write(&path, packed(count, columns)).unwrap();
        let read = files::read_within(&path, None, Memory::bytes(most)).unwrap_err();
        read.to_string().split_once("p.hdf5: ").unwrap().1.to_string()
    };
    let limit = "the limit is 10 MB";
    assert_eq!(
        read(200_000, 199_999, 10_000_000),
        format!("/fclib_local/W/x of 200000 numbers needs 11.2 MB; {limit}")
    );
    assert!(path.metadata().unwrap().len() < 20_000);
    // Each for itself would pass.
    assert_eq!(
        read(100_000, 99_999, 10_000_000),
        format!("/fclib_local/W/i of 100000 numbers needs 11.2 MB; {limit}")
    );
    assert_eq!(read(1000, 3, 10_000_000), "/fclib_local/W/p: has 1000 numbers, must have 4");
}

/// A global problem of one contact whose M has these triplets, with other datasets beside it.
fn global(mass: &[(i32, i32, f64)], others: &[&str]) -> Result<Problem, String> {
    let mut file = Hdf5Builder::new();
    let whole = |name: &str, values: &[i32]| {
        DatasetBuilder::typed_data(
            format!("fclib_global/{name}"),
            vec![values.len() as u64],
            values,
        )
    };
    let real = |name: &str, values: &[f64]| {
        DatasetBuilder::typed_data(
            format!("fclib_global/{name}"),
            vec![values.len() as u64],
            values,
        )
    };
    let unit = [(0, 0, 1.0), (1, 1, 1.0), (2, 2, 1.0)];
    for (name, entries) in [("M", mass), ("H", &unit)] {
        let part = |part: &str| format!("{name}/{part}");
        let columns: Vec<i32> = entries.iter().map(|(_, j, _)| *j).collect();
        let lines: Vec<i32> = entries.iter().map(|(i, _, _)| *i).collect();
        let values: Vec<f64> = entries.iter().map(|(_, _, value)| *value).collect();
        for (part, value) in [(part("m"), 3), (part("n"), 3), (part("nz"), entries.len() as i32)] {
            file = file.dataset(whole(&part, &[value]).unwrap());
        }
        file = file.dataset(whole(&part("p"), &columns).unwrap());
        file = file.dataset(whole(&part("i"), &lines).unwrap());
        file = file.dataset(real(&part("x"), &values).unwrap());
    }
    file = file.dataset(whole("spacedim", &[3]).unwrap());
    for (name, values) in [("f", &[0.0; 3][..]), ("w", &[-1.0, 0.0, 0.0]), ("mu", &[0.5])] {
        file = file.dataset(real(&format!("vectors/{name}"), values).unwrap());
    }
    for name in others {
        file = file.dataset(DatasetBuilder::typed_data(*name, vec![1], &[1.0f64]).unwrap());
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.hdf5");
    let bytes = file.into_plan().unwrap().encode(WriteOptions::default()).unwrap();
    std::fs::write(&path, bytes).unwrap();
    let short = |error: lcplab_lcp::error::Error| {
        error.to_string().split_once("p.hdf5: ").unwrap().1.to_string()
    };
    files::read(&path, None).map_err(short)
}

const DIAGONAL: [(i32, i32, f64); 3] = [(0, 0, 2.0), (1, 1, 2.0), (2, 2, 4.0)];

#[test]
fn a_dataset_that_is_not_understood_is_refused() {
    for other in ["fclib_global/vectors/mu_r", "fclib_global/V/m", "other/M/x", "extra"] {
        let expected = format!("/{other}: is not understood");
        assert_eq!(global(&DIAGONAL, &[other]).unwrap_err(), expected);
    }
    let several = global(&DIAGONAL, &["fclib_local/spacedim"]).unwrap_err();
    assert!(several.contains("contains several problems"), "{several}");
}

#[test]
fn answers_beside_a_problem_are_reported_and_remarks_are_not() {
    let remarks = ["fclib_global/M/rank", "fclib_global/H/nzmax", "fclib_global/info/number"];
    assert_eq!(global(&DIAGONAL, &remarks).unwrap().warnings, [""; 0]);
    let warnings = global(&DIAGONAL, &["solution/r", "guesses/0/u"]).unwrap().warnings;
    let expected = "p.hdf5: not part of the problem: guesses, solution";
    assert!(warnings.len() == 1 && warnings[0].ends_with(expected), "{warnings:?}");
}

/// Of a matrix of which half is stored, a symmetric factorization of the other half would see the
/// diagonal alone.
#[test]
fn one_triangle_of_a_matrix_is_not_taken_for_all_of_it() {
    for (i, j) in [(0, 1), (1, 0)] {
        let half = [&DIAGONAL[..], &[(i, j, 1.0)]].concat();
        let message = global(&half, &[]).unwrap_err();
        assert!(message.starts_with("/fclib_global/M: has entries on one side"), "{message}");
    }
    let all = [&DIAGONAL[..], &[(0, 1, 1.0), (1, 0, 1.0)]].concat();
    let a = rows(global(&all, &[]).unwrap().lcp.matrix());
    let expected = [2.0 / 3.0, -1.0 / 3.0, 0.25]; // [2 1; 1 2]⁻¹ ⊕ ¼
    for (found, expected) in [a[0][0], a[0][1], a[2][2]].iter().zip(expected) {
        assert!((found - expected).abs() <= f64::EPSILON, "{a:?}");
    }
}

#[test]
fn rolling_friction_is_refused_by_name() {
    let mut file = Hdf5Builder::new();
    let name = "fclib_global_rolling/spacedim";
    file = file.dataset(DatasetBuilder::typed_data(name, vec![1], &[3i32]).unwrap());
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.hdf5");
    let bytes = file.into_plan().unwrap().encode(WriteOptions::default()).unwrap();
    std::fs::write(&path, bytes).unwrap();
    let message = files::read(&path, None).unwrap_err().to_string();
    assert!(message.contains("holds contacts with rolling friction"), "{message}");
}

#[test]
fn only_contacts_and_equations_are_written() {
    let boxed = lcplab_lcp::library::by_name("manufactured").unwrap().generate(&[]).unwrap();
    assert_eq!(
        refusal(&boxed, "fclib"),
        "fclib: friction_index: is missing: there are no contacts"
    );
}

proptest! {
    #![proptest_config(cases(40))]

    #[test]
    fn every_bit_survives_the_round_trip(problem in (0usize..2).prop_flat_map(frictions)) {
        let back = again(&problem, "fclib");
        assert_same(&problem.lcp, &back.lcp);
        prop_assert_eq!(back.name, "frictions");
    }
}

/// A unit mass on a plane of friction ½, W = [1 0.2; 0.2 1] and q = (−1, −2): it slides, so x_t =
/// x_n / 2 and 1.1 x_n = 1.
#[test]
fn contacts_in_the_plane_are_boxes_of_a_normal_and_a_tangent() {
    let read = |dimension: i32| {
        let mut file = Hdf5Builder::new();
        let name = |part: &str| format!("fclib_local/{part}");
        let whole = [("spacedim", dimension), ("W/m", 2), ("W/n", 2), ("W/nz", -1)];
        for (part, value) in whole {
            file = file.dataset(DatasetBuilder::typed_data(name(part), vec![1], &[value]).unwrap());
        }
        for (part, values) in [("W/p", vec![0, 2, 4]), ("W/i", vec![0, 1, 0, 1])] {
            let length = vec![values.len() as u64];
            file = file.dataset(DatasetBuilder::typed_data(name(part), length, &values).unwrap());
        }
        for (part, values) in [
            ("W/x", vec![1.0, 0.2, 0.2, 1.0]),
            ("vectors/q", vec![-1.0, -2.0]),
            ("vectors/mu", vec![0.5]),
        ] {
            let length = vec![values.len() as u64];
            file = file.dataset(DatasetBuilder::typed_data(name(part), length, &values).unwrap());
        }
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.hdf5");
        let bytes = file.into_plan().unwrap().encode(WriteOptions::default()).unwrap();
        std::fs::write(&path, bytes).unwrap();
        let read = files::read(&path, None);
        read.map_err(|error| error.to_string().replace(path.to_str().unwrap(), "p"))
    };
    let problem = read(2).unwrap();
    assert_eq!((problem.model, problem.lcp.coupled_to(1)), (None, Some((0, 0.5))));
    assert_proved(&problem.lcp, &[10.0 / 11.0, 5.0 / 11.0]);
    assert_eq!(
        read(4).unwrap_err(),
        "p: /fclib_local/spacedim: is 4, must be 2 (the plane) or 3 (space)"
    );
    assert_eq!(read(3).unwrap_err(), "p: /fclib_local/vectors/mu: has 1 numbers, must have 0");
}
