//! The runs of `examples/long_run`, cut short.

#[path = "../../examples/long_run/record.rs"]
mod record;

use record::RUNS;

#[test]
fn two_thousand_steps_gain_no_energy_and_break_no_bound() {
    for run in RUNS {
        let record = run.record(2000).unwrap();
        assert_eq!(run.broken(&record), [""; 0], "{} {record:?}", run.scene);
    }
}
