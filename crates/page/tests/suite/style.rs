use lcplab_page::plot::style::{style, styles};

#[test]
fn spelling_does_not_change_the_look() {
    assert_eq!(style("Block PGS"), style("block_pgs"));
    assert_eq!(style("sor(1.5)"), style("SOR, ω = 1.50"));
}

#[test]
fn names_that_would_look_the_same_differ_in_a_figure() {
    let names = ["sor ω = 1.31", "sor ω = 1.311", "mine", "mine", "mine", "mine", "mine"];
    let looks = styles(&names);
    for (k, look) in looks.iter().enumerate() {
        assert!(!looks[..k].contains(look), "{k}");
    }
    assert_eq!(looks[0], style(names[0]));
}

#[test]
fn steps_of_one_scheme_keep_its_hue_and_change_the_dash() {
    let looks = ["velocity, dt", "velocity, dt/2", "velocity, dt/4"].map(style);
    assert_eq!(looks[2].color, style("velocity").color);
    assert!(looks[0].dash != looks[1].dash && looks[1].dash != looks[2].dash);
}
