use hdf5_writer::{DatasetBuilder, FilterDescription, Hdf5Builder, WriteOptions};
use lcplab_files as exchange;
use lcplab_problem::friction::{Contact, Model};
use lcplab_problem::memory::Memory;
use proptest::prelude::*;

use super::{again, assert_same, frictions, message, refusal, rows, sample};
use lcplab_testing::{INF, cases};

#[test]
fn a_local_problem_is_read_with_its_unsymmetric_w() {
    let problem = exchange::read(&sample("fclib_local.hdf5"), None).unwrap();
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
    let problem = exchange::read(&sample("fclib_global.hdf5"), None).unwrap();
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
    assert!(message("fclib", "\u{89}HDF, but nothing else").starts_with("p: file: "));
}

/// A file of contacts without friction whose zeros are packed a thousandfold, with so many of them in
/// each array of W, and rows that `columns` says.
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
        let read = exchange::read_within(&path, None, Memory::bytes(most)).unwrap_err();
        read.to_string().split_once("p.hdf5: ").unwrap().1.to_string()
    };
    let limit = "the limit is 10 MB (raise it with --max-memory)";
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

#[test]
fn only_contacts_and_equations_are_written() {
    let boxed = lcplab_problem::library::by_name("manufactured").unwrap().generate(&[]).unwrap();
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
