//! A page with every kind of block, whose numbers are known.

use lcplab::animation::{Animation, Recording, Strip};
use lcplab::plot::{Axis, Bar, Bars, Figure, Lines, Panel, Series, Spy};
use lcplab::report::page::{
    Block, Cell, Column, Mark, Origin, Page, Picture, Player, Section, Table, Tile,
};
use lcplab::scene::Scene;
use lcplab::simulation;
use lcplab::simulation::Simulation;

/// Every kind of block.
pub fn page() -> Page {
    let words = "A *word* and $x^2$, a [link](#figures) and a [file](data/squares.csv).\n\n- one\n\
                 - two\n\n### A heading\n\n| a | b |\n| --- | ---: |\n| 1 | 2 |";
    let text = Section {
        id: "words".into(),
        title: "Words & signs <".into(),
        blocks: vec![
            Block::Text(words.into()),
            Block::Equation { latex: "w = A x + b".into(), label: Some("K&M 1".into()) },
            Block::Note("A note with `code`.".into()),
            Block::Code { language: "rust".into(), text: "let x = 1 < 2;".into() },
        ],
        ..Section::default()
    };
    let mut pictures = Section {
        id: "figures".into(),
        title: "Figures".into(),
        blocks: figures()
            .iter()
            .map(|figure| Block::Figure(Picture::of(figure.as_ref(), "data")))
            .collect(),
        ..Section::default()
    };
    for figure in [&pattern() as &dyn Figure, &strip()] {
        pictures.blocks.push(Block::Figure(Picture { svg: figure.svg(), ..Picture::default() }));
    }
    pictures.blocks.push(Block::Player(Box::new(player())));
    pictures.origin = Some(Origin {
        scene: "none: numbers in closed form".into(),
        settings: "factor ½".into(),
        command: "lcplab report <folder>/results.json".into(),
    });
    let tables = Section {
        id: "tables".into(),
        title: "Tables".into(),
        blocks: vec![Block::Table(squares()), Block::Table(tall())],
        ..Section::default()
    };
    Page {
        title: "Every kind of block".into(),
        lead: "A page for tests.".into(),
        opening: vec![Block::Tiles(vec![tile("words", true), tile("tables", false)])],
        sections: vec![text, pictures, tables],
        facts: vec![("lcplab".into(), "today".into())],
        ..Page::default()
    }
}

fn tile(section: &str, good: bool) -> Tile {
    Tile { value: "2 of 3".into(), label: "a <result>".into(), section: section.into(), good }
}

/// The figures whose files lie in the folder `data`.
pub fn figures() -> [Box<dyn Figure>; 3] {
    [Box::new(halving()), Box::new(growth()), Box::new(times())]
}

/// A residual that is halved in a sweep, nine times, and is then exactly zero; and its theory.
pub fn halving() -> Lines {
    let halved: Vec<_> = (0..9).map(|k| (f64::from(k), 0.5f64.powi(k))).collect();
    let measured = halved.iter().copied().chain([(9.0, 0.0)]).collect();
    let series = vec![
        Series::measured("pgs", measured),
        Series::measured("dantzig", vec![(0.0, 1.0), (1.0, 0.01)]),
        Series::theory("theory, pgs: halved", halved),
        Series::theory("theory, dantzig", vec![(0.0, 1.0), (1.0, 0.01)]),
        Series::reference("tolerance", vec![(0.0, 0.1), (9.0, 0.1)]),
    ];
    Lines {
        id: "halving".into(),
        title: "Halved in a sweep".into(),
        caption: "See $2^{-k}$.".into(),
        x: Axis::linear("sweep", ""),
        panels: vec![Panel { y: Axis::log("residual", "m/s"), series }],
    }
}

/// Two panels of two curves.
fn growth() -> Lines {
    let curve = |name: &str, rate: f64| {
        Series::measured(
            name,
            (0..=1000).map(|k| (f64::from(k) * 0.01, rate * f64::from(k))).collect(),
        )
    };
    let panel = |label: &str, unit: &str, rate: f64| Panel {
        y: Axis::linear(label, unit),
        series: vec![curve("velocity, dt", rate), curve("velocity, dt/2", 2.0 * rate)],
    };
    Lines {
        id: "growth".into(),
        title: "Two that grow".into(),
        caption: "Both are straight.".into(),
        x: Axis::linear("time", "s"),
        panels: vec![panel("energy", "J", 1.0), panel("drift", "m", -1e-9)],
    }
}

/// Two bars.
fn times() -> Bars {
    let bars = [("pgs", 3.25), ("lemke", 0.5)].map(|(name, value)| Bar {
        name: name.into(),
        accent: false,
        value,
        amount: value.to_string(),
        others: Vec::new(),
    });
    let (title, caption) = ("Time a step".into(), "Shorter is better.".into());
    Bars {
        id: "times".into(),
        title,
        caption,
        x: Axis::linear("time", "ms"),
        bars: bars.into(),
        limit: None,
    }
}

fn pattern() -> Spy {
    Spy::new("pattern", "A diagonal", "", (9, 9), (0..9).map(|k| (k, k))).unwrap()
}

fn strip() -> Strip {
    let scene = Scene::load("stack").unwrap();
    let frame = lcplab::animation::Frame::start(&scene);
    Strip::new(&scene, vec![frame])
}

/// A swinging pendulum, eleven instants.
fn player() -> Player {
    let scene = Scene::load("pendulum").unwrap();
    let recording = |name: &str| {
        let mut simulation = Simulation::new(scene.clone(), simulation::solver(&scene).unwrap());
        Recording::of(name, &mut simulation, 100, 11)
    };
    let animation = Animation::new("swing", &scene, vec![recording("dantzig"), recording("pgs")]);
    Player { animation: animation.drawn(), caption: "It swings.".into(), files: Vec::new() }
}

/// A small table: the order of its rows is neither that of the names nor that of the numbers.
fn squares() -> Table {
    let row = |name: &str, value: f64, mark: Mark| {
        vec![Cell::text(name).marked(mark), Cell::number(value, 3)]
    };
    Table {
        title: "Squares".into(),
        how_to_read: "The number is the *square* of the name.".into(),
        columns: vec![Column::words("name"), Column::numbers("square", "m²")],
        rows: vec![
            row("ten", 100.0, Mark::Good),
            row("a third", 1.0 / 9.0, Mark::Plain),
            row("million", 1e12, Mark::Bad),
            row("minus nothing", -0.0, Mark::Note),
        ],
        files: vec![("data (CSV)".into(), "data/squares.csv".into())],
        ..Table::default()
    }
}

/// A table that is longer and wider than a screen.
fn tall() -> Table {
    let wide = 14;
    let columns = (0..wide).map(|k| Column::numbers(format!("column {k}"), "N s/m"));
    let row = |i: usize| (0..wide).map(|k| Cell::number(1234.5 * (i + k) as f64, 7)).collect();
    Table {
        title: "Many numbers".into(),
        columns: columns.collect(),
        rows: (0..60).map(row).collect(),
        ..Table::default()
    }
}
