//! The shipped scenes.

use lcplab_mechanics::scene::{Scene, catalogue, schema};

#[test]
fn every_shipped_scene_loads_and_says_what_it_teaches() {
    for shipped in catalogue::SHIPPED {
        let scene = shipped.scene().unwrap();
        assert_eq!(scene.name, shipped.name);
        assert!(!scene.title.is_empty() && scene.teaches.len() > 100, "{}", shipped.name);
        assert!(!scene.title.contains('\n'));
    }
}

#[test]
fn every_file_of_the_folder_is_shipped() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes");
    let mut files: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path().file_stem().unwrap().to_string_lossy().into())
        .collect();
    let mut shipped: Vec<String> = catalogue::SHIPPED.iter().map(|s| s.name.into()).collect();
    files.sort();
    shipped.sort();
    assert_eq!(files, shipped);
}

#[test]
fn a_scene_is_the_same_by_name_and_by_path() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/net.toml");
    let (by_name, by_path) = (Scene::load("net").unwrap(), Scene::load(path).unwrap());
    assert_eq!(format!("{by_name:?}"), format!("{by_path:?}"));
    assert_eq!(by_name.bodies.len(), 400);
    assert_eq!(by_name.constraints.len(), 764); // 2 · 20 · 19 rods and 4 that it hangs on
}

#[test]
fn an_unknown_name_gives_the_number_of_shipped_ones_and_the_nearest() {
    let message = Scene::load("pendulm").unwrap_err().to_string();
    let count = catalogue::SHIPPED.len();
    let words = format!(
        "there is no scene file or shipped scene named \"pendulm\"; there are {count}, such as pendulum, "
    );
    assert!(message.starts_with(&words), "{message}");
}

#[test]
fn the_schema_knows_every_section_with_its_units() {
    let schema = schema().to_string();
    for word in ["bodies", "constraints", "restitution", "Mass (kg)", "The length of a step (s)"] {
        assert!(schema.contains(word), "{word}");
    }
}
