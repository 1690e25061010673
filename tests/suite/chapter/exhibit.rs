//! Each erratum is shown by its example: the printed form fails, the corrected one holds.

use lcplab::chapter::exhibit::{ALL, Evidence};
use lcplab::document::Format;

#[test]
fn every_example_tells_the_printed_form_from_the_corrected_one() {
    for exhibit in ALL {
        if let Evidence::Example(example) = exhibit.evidence {
            let finding = example().unwrap();
            let text = exhibit.document().unwrap().written(Format::Text).unwrap();
            assert!(finding.is_shown(), "{text}");
        }
    }
}
