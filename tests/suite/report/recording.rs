use lcplab::report::recording::Record;
use lcplab::scene::Scene;
use lcplab::simulation::Simulation;

#[test]
fn a_record_names_the_constraints_that_fight() {
    let scene = Scene::load("fig8").unwrap();
    let mut simulation = Simulation::of(&scene).unwrap();
    let mut record = Record::start(&scene, &simulation);
    record.add(&simulation.step().unwrap());
    let fighting = "coincidence world left 0, coincidence world right 0, distance left right 0";
    assert!(!record.is_good());
    assert!(record.text().contains(fighting), "{}", record.text());
}
