//! Every registered solver has a look of its own.

use lcplab::plot::style::style;
use lcplab::solver::{ALL, KNOWN_WRONG};

#[test]
fn no_two_solvers_look_the_same_in_grey() {
    let registered = ALL.iter().chain(KNOWN_WRONG).map(|entry| entry.name).filter(|&n| n != "sor");
    let sor = ["sor ω = 0.8", "sor ω = 1.3", "sor ω = 1.5", "sor ω = 1.7", "sor ω = 1.9"];
    let names: Vec<&str> = registered.chain(["clarabel"]).chain(sor).collect();
    let looks: Vec<_> = names.iter().map(|name| style(name)).collect();
    for (k, a) in looks.iter().enumerate() {
        let same = looks[..k].iter().position(|b| (a.dash, a.marker) == (b.dash, b.marker));
        assert!(same.is_none(), "{} looks as {} does in gray", names[k], names[same.unwrap()]);
    }
}

#[test]
fn an_unlisted_solver_differs_from_all_listed_ones_in_gray() {
    let listed: Vec<_> = ALL.iter().map(|entry| style(entry.name)).collect();
    for k in 0..100 {
        let own = style(&format!("solver {k}"));
        let same =
            listed.iter().position(|other| (own.dash, own.marker) == (other.dash, other.marker));
        assert_eq!(same.map(|at| ALL[at].name), None, "solver {k}");
    }
}
