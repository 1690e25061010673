//! Figures: nothing is lost in the data, nothing panics, the same bytes each time.

mod grades;
mod heat;
mod line;
mod markup;
mod profile;
mod spy;
mod style;
mod table;
mod unicode;
mod well_formed;

pub use well_formed::assert_well_formed;

use lcplab_page::plot::{Axis, Bar, Bars, Figure};
use lcplab_page::{csv, number};

#[test]
fn bars_without_a_place_are_written() {
    for axis in [Axis::linear("time", "s"), Axis::log("time", "s")] {
        let bars = [("pgs", 3.0), ("lemke", 0.0), ("murty", f64::NAN), ("dantzig", -1.0)];
        let bars = bars
            .map(|(name, value)| Bar {
                name: name.into(),
                accent: false,
                value,
                amount: number::readable(value, 3),
                others: Vec::new(),
            })
            .into();
        let (title, caption) = ("Time <by> solver".into(), String::new());
        let figure = Bars {
            id: "time".into(),
            title,
            caption,
            x: axis,
            bars,
            limit: Some((2.0, "most".into())),
        };
        assert_well_formed(&figure);
        assert!(figure.svg().contains("not a number") && figure.svg().contains("&lt;by&gt;"));
        let rows = "pgs,3,dark\nlemke,0,dark\nmurty,nan,dark\ndantzig,-1,dark\nmost,2,line\n";
        assert_eq!(figure.csv(), format!("name,time (s),drawn\n{rows}"));
    }
}

#[test]
fn csv_quotes_what_needs_quotes() {
    let mut out = String::new();
    csv::record(&mut out, ["plain", "a,b", "say \"w\"", "two\nlines"]);
    assert_eq!(out, "plain,\"a,b\",\"say \"\"w\"\"\",\"two\nlines\"\n");
}

#[test]
fn no_csv_field_is_a_formula_and_numbers_stay_numbers() {
    let mut out = String::new();
    csv::record(&mut out, ["=1+2", "+A1", "-A1", "@SUM(1,2)", "\t=1", "a=b"]);
    csv::record(&mut out, ["-1.5", "+2", "-inf", "-1e-300", "", "-"]);
    let formulas = "'=1+2,'+A1,'-A1,\"'@SUM(1,2)\",'\t=1,a=b\n";
    assert_eq!(out, format!("{formulas}-1.5,+2,-inf,-1e-300,,'-\n"));
}

#[test]
fn csv_numbers_read_back_as_themselves() {
    for value in [0.1, 1.0 / 3.0, 1e-300, 5e-324, f64::MAX, -0.0, 123456789.0] {
        let text = csv::number(value);
        assert_eq!(text.parse::<f64>().unwrap().to_bits(), value.to_bits(), "{text}");
    }
    assert_eq!(csv::number(3.0), "3");
    assert_eq!(csv::number(f64::NEG_INFINITY), "-inf");
}

#[test]
fn numbers_read_well() {
    assert_eq!(number::readable(0.0, 3), "0");
    assert_eq!(number::readable(9.996, 3), "10");
    assert_eq!(number::readable(99999.6, 3), "10⁵");
    assert_eq!(number::readable(-1e-7, 2), "−10⁻⁷");
    assert_eq!(number::significant(3e-8, 2), "3.0×10⁻⁸");
    assert_eq!(number::significant(0.25, 3), "0.250");
    assert_eq!(
        (number::tabular(0.25, 3), number::tabular(-3e-8, 2)),
        ("0.25".into(), "−3×10⁻⁸".into())
    );
    assert_eq!(number::readable(-1234.5, 2), "−1,200");
    assert_eq!(number::count(1234567), "1,234,567");
}
