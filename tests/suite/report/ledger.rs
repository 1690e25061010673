//! Energy balances with closed forms, and orders of errors.

use lcplab::report::page::Mark;
use lcplab::report::study::Study;
use lcplab::report::study::drift::ledger::Account;
use lcplab::report::study::drift::order::{Curve, Expected, Sample};
use lcplab::report::study::drift::{Finding, Plan};
use lcplab::report::view::{Outcome, ReportPage, View};
use lcplab::solver::Registry;

/// The plan of one run, and what it finds.
fn audited(run: &str) -> (Plan, Account) {
    let plan: Plan = toml::from_str(run).unwrap();
    let Finding::Ledger(found) = plan.run(0, Registry::standard()).unwrap().0 else {
        panic!("a ledger")
    };
    (plan, found)
}

fn outcome(plan: &Plan, account: &Account) -> Outcome {
    plan.outcome(&[Finding::Ledger(account.clone())])
}

fn books(scene: &str, duration: f64) -> Account {
    let run = format!(
        "[[ledgers]]\nname = 'r'\ntitle = 'r'\ntext = ''\nscene = '{scene}'\nduration = {duration:?}"
    );
    let (plan, found) = audited(&run);
    assert!(outcome(&plan, &found).good);
    found
}

fn account(finding: &Account, name: &str) -> f64 {
    let k = finding.accounts.iter().position(|account| account == name).unwrap();
    finding.books.last().unwrap().accounts[k]
}

/// The books of a run of the pendulum by a scheme.
fn swung(scheme: &str) -> (Plan, Account) {
    let run = format!(
        "[[ledgers]]\nname = 'r'\ntitle = 'r'\ntext = ''\nscene = 'pendulum'\nduration = 0.2\n\
         change = {{ step = {{ scheme = '{scheme}' }} }}"
    );
    audited(&run)
}

#[test]
fn a_family_that_does_not_write_down_what_acts_is_not_accounted() {
    let (plan, found) = swung("xpbd");
    assert!(found.remainder.is_none() && found.accounts.is_empty());
    let outcome = outcome(&plan, &found);
    assert_eq!(
        (outcome.good, outcome.says.as_str()),
        (true, "0 of 0 energy ledgers balance, 1 without a ledger")
    );
    let table = ReportPage::of(&plan, &[Finding::Ledger(found)]).tables[0].1.clone();
    let last = table.rows[0].last().unwrap();
    assert_eq!((last.text.as_str(), last.mark), ("not accounted", Mark::Plain));
}

#[test]
fn books_in_which_a_percent_is_missing_do_not_balance() {
    for scheme in ["velocity", "penalty", "soft", "split-impulse"] {
        let (plan, mut found) = swung(scheme);
        let says = |found: &Account| outcome(&plan, found).says;
        assert_eq!(says(&found), "1 of 1 energy ledgers balance");
        found.remainder = Some(0.01 * found.turnover);
        assert_eq!(says(&found), "0 of 1 energy ledgers balance", "{scheme}");
    }
}

#[test]
fn what_semi_implicit_euler_loses_in_a_fall_stands_under_the_integrator() {
    // z is too low by g t dt/2, so the energy by m g² t dt/2: m = 3 kg, t = 1 s, dt = 0.01 s.
    let found = books("free_fall", 1.0);
    let lost = -0.5 * 3.0 * 9.81 * 9.81 * 0.01;
    assert!((account(&found, "integrator") - lost).abs() < 1e-9);
    let last = found.books.last().unwrap();
    assert!((last.kinetic + last.potential - lost).abs() < 1e-9);
}

#[test]
fn a_block_that_slides_to_rest_loses_its_energy_to_friction_alone() {
    let found = books("sliding", 1.0);
    assert!((account(&found, "friction") + 0.5 * 2.0 * 9.0).abs() < 1e-6);
    assert!(account(&found, "contact").abs() < 1e-9 && account(&found, "bias").abs() < 1e-9);
}

fn curve(error: impl Fn(f64) -> f64) -> Curve {
    let steps = [0.08, 0.04, 0.02, 0.01];
    Curve {
        quantity: "place".into(),
        unit: "m".into(),
        method: "velocity".into(),
        errors: steps.map(|dt| Sample { dt, error: error(dt) }).to_vec(),
        expected: Expected::Order { order: 2.0, because: String::new() },
    }
}

#[test]
fn the_order_of_a_power_is_its_exponent() {
    let square = curve(|dt| 3.0 * dt * dt);
    let (slope, spread) = square.fitted().unwrap();
    assert!((slope - 2.0).abs() < 1e-12 && spread < 1e-12);
    assert!((square.observed().unwrap() - 2.0).abs() < 1e-12);
    assert_eq!(square.holds(), Some(true));
}

#[test]
fn an_error_that_stays_passes_for_no_order() {
    let constant = curve(|dt| 1e-3 + dt * dt * 1e-3);
    assert_eq!(constant.holds(), Some(false));
    assert!(constant.fitted().unwrap().0 < 0.01);
    assert_eq!(curve(|_| f64::NAN).holds(), Some(false));
}

#[test]
fn errors_of_all_families_shrink_as_derived() {
    let plan: Plan =
        toml::from_str("[orders]\nproblems = ['fall', 'swing', 'slide']\nhalvings = 3").unwrap();
    let findings: Vec<Finding> =
        (0..3).map(|k| plan.run(k, Registry::standard()).unwrap().0).collect();
    let curves = findings.iter().flat_map(|finding| match finding {
        Finding::Order(order) => order.curves.as_slice(),
        other => panic!("orders: {other:?}"),
    });
    let wrong: Vec<_> = curves.filter(|curve| curve.holds() == Some(false)).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(plan.outcome(&findings).good);
}
