use lcplab::storage::{ALL, Dense, Error, Storage};

#[test]
fn what_code_10_asserts_is_an_error_and_changes_nothing() {
    for kind in &ALL {
        let mut a = (kind.new)(2, 3);
        a.set(1, 2, 7.0).unwrap();
        let outside = |row, column| Error::Outside { row, column, rows: 2, columns: 3 };
        assert_eq!(a.get(2, 0), Err(outside(2, 0)), "{}", kind.name);
        assert_eq!(a.get(0, 3), Err(outside(0, 3)), "{}", kind.name);
        assert_eq!(a.set(2, 0, 1.0), Err(outside(2, 0)), "{}", kind.name);
        assert_eq!(a.row(2), Err(outside(2, 0)), "{}", kind.name);
        let infinite = Error::NotFinite { row: 0, column: 0, value: f64::INFINITY };
        assert_eq!(a.set(0, 0, f64::INFINITY), Err(infinite), "{}", kind.name);
        assert!(matches!(a.set(0, 0, f64::NAN), Err(Error::NotFinite { .. })), "{}", kind.name);
        let unordered = a.load(&[(0, 1, 1.0), (0, 1, 2.0)]);
        assert_eq!(unordered, Err(Error::Unordered { row: 0, column: 1 }), "{}", kind.name);
        assert_eq!(a.row(1).unwrap(), [(2, 7.0)], "{}", kind.name);
        assert!(a.row(0).unwrap().is_empty(), "{}", kind.name);
    }
}

#[test]
fn an_error_becomes_one_of_the_library_with_its_numbers() {
    let error = Dense::new(2, 2).get(0, 9).unwrap_err();
    let text = lcplab::error::Error::from(error).to_string();
    assert_eq!(text, "matrix: storage: entry (0, 9) is outside a 2 × 2 matrix");
}
