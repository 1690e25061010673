//! A of one step, next to its scene, and the factors of another.

use crate::animation::{Frame, Strip};
use crate::number::{capitalized, count, readable};
use crate::plot::scene_matrix::{self, SCENE, SceneMatrix};
use crate::plot::{Small, Spy};
use crate::report::page::markup::literal;
use crate::report::study::sparsity::factor::{Factor, Ordered};
use crate::report::study::sparsity::pattern::{Block, Patterns};
use crate::report::view::ReportPage;
use crate::report::view::attempt::stem;
use crate::scene::Scene;
use crate::storage::Ordering;

/// A larger matrix is drawn as a raster.
const MOST: usize = 200;

pub(super) fn show(scenes: &[&Patterns], factors: &[&Factor], document: &mut ReportPage) {
    document.text(
        "Two rows of $A = J M^{-1} J^T$ are coupled only if they share a moving body, so the larger the scene, the \
         sparser its $A$ (the chapter's Figure 13). The work of a sweep that skips the zeros is proportional to the number \
         of contacts, not to its square. A direct method factors $A = L L^T$, and $L$ has additional entries, the fill-in, \
         whose number depends on the order of elimination.",
    );
    for (k, scene) in scenes.iter().enumerate() {
        if scene.blocks.is_empty() || scene.rows > MOST {
            raster(scene, document);
        } else {
            document.figure(figure(scene, if k == 0 { factors } else { &[] }));
        }
    }
}

fn raster(scene: &Patterns, document: &mut ReportPage) {
    let id = format!("sparsity_{}_matrix", stem(&scene.scene));
    let places = scene.matrix.iter().map(|&(i, j, _)| (i, j));
    let title = format!("A: {}", scene.scene);
    if let Ok(spy) = Spy::new(id, title, literal(&scene.title), (scene.rows, scene.rows), places) {
        document.figure(spy);
    }
}

fn figure(found: &Patterns, factors: &[&Factor]) -> SceneMatrix {
    let rows = |block: &Block| scene_matrix::Block {
        name: block.name.clone(),
        bodies: block.bodies.clone(),
        second: block.friction.clone(),
    };
    let fill = |entries: usize, of: usize| readable(100.0 * entries as f64 / of as f64, 3);
    let full = fill(found.matrix.len(), found.rows * found.rows);
    let shares = |a: &&Block, b: &Block| a.bodies.iter().any(|body| b.bodies.contains(body));
    let blocks = found.blocks.iter();
    let pairs: Vec<_> = blocks
        .flat_map(|a| found.blocks.iter().filter(move |b| shares(&a, b)).map(move |b| (a, b)))
        .collect();
    let coupled: usize = pairs.iter().map(|(a, b)| a.friction.len() * b.friction.len()).sum();
    let all = found.blocks.len().pow(2);
    SceneMatrix {
        id: format!("sparsity_{}", stem(&found.scene)),
        title: capitalized(&format!("{}the {}'s A is {full} % full", gain(factors), found.scene)),
        caption: format!(
            "The scene, and its A in step {} ({} rows): a block couples the rows of one pair of bodies with those of another. Pale \
             entries are below 30 % of the largest |a|, the palest below 3 %. Blocks without a common moving body are empty; the other {} of {all} are {} % \
             full, because in some entries the contributions of translation and rotation cancel. {}",
            found.step,
            count(found.rows),
            pairs.len(),
            fill(found.matrix.len(), coupled),
            factors.iter().map(|factor| words(factor)).collect::<Vec<_>>().join(" ")
        ),
        scene: picture(found).unwrap_or_default(),
        blocks: found.blocks.iter().map(rows).collect(),
        kinds: ["normal".into(), "friction".into()],
        entries: found.matrix.clone(),
        factors: factors.iter().flat_map(|factor| panels(factor)).collect(),
    }
}

/// The factors that are drawn: with the natural order, and with the fewest entries.
fn drawn(factor: &Factor) -> impl Iterator<Item = &Ordered> {
    let is_drawn = |own: &&Ordered| own.ordering != Ordering::ReverseCuthillMcKee.name();
    factor.ordered.iter().filter(is_drawn)
}

/// What reordering saves.
fn gain(factors: &[&Factor]) -> String {
    let gain = |factor: &&Factor| {
        let entries: Vec<String> = drawn(factor).map(|own| count(own.entries)).collect();
        let (natural, least) = (entries.first()?, entries.last()?);
        Some(format!("Reordering cuts the entries of L from {natural} to {least}; "))
    };
    factors.iter().filter_map(gain).collect()
}

fn words(factor: &Factor) -> String {
    format!(
        "Below: the factor of {} in step {} ({} rows, {} entries of A that are not 0 on and below the diagonal).",
        factor.scene,
        factor.step,
        count(factor.rows),
        count(factor.lower)
    )
}

fn panels(factor: &Factor) -> impl Iterator<Item = Small> {
    drawn(factor).map(|own| Small {
        name: format!("L of {}, {}", factor.scene, own.ordering),
        note: format!("{} entries{}", count(own.entries), own.picture.key()),
        raster: own.picture.clone(),
    })
}

/// The scene at its start.
fn picture(found: &Patterns) -> Option<String> {
    let scene = Scene::load(&found.scene).ok()?;
    Some(Strip::new(&scene, vec![Frame::start(&scene)]).still(SCENE))
}
