//! A of the shipped scenes.

use crate::number::{count, readable};
use crate::plot::{Small, Spies};
use crate::report::study::sparsity::gallery::Picture;
use crate::report::view::ReportPage;

/// The number of pictures in a figure, and per row.
const PICTURES: usize = 25;
const ACROSS: usize = 5;

pub(super) fn show(pictures: &[Picture], document: &mut ReportPage) {
    document.text(
        "**A of the shipped scenes.** The rows are in the order of the joints of the scene, then its contacts, \
         each with a normal and two tangents. Two rows have a common entry in A if they share a moving body. A \
         chain gives a band, a stack a band of blocks, and a net two bands whose distance is the width of the \
         net. A body with many contacts gives a full square. Matrices without rows or without zeros are not \
         shown.",
    );
    let has_pattern = |picture: &&Picture| (1e-9..100.0).contains(&picture.raster.fill());
    let pictures: Vec<&Picture> = pictures.iter().filter(has_pattern).collect();
    let figures = pictures.len().div_ceil(PICTURES);
    for (k, some) in pictures.chunks(PICTURES).enumerate() {
        let small = |picture: &&Picture| Small {
            name: picture.scene.clone(),
            note: note(picture),
            raster: picture.raster.clone(),
        };
        document.figure(Spies {
            id: format!("sparsity_scenes_{}", k + 1),
            title: title(k + 1, figures),
            caption: String::from(
                "Under each name: the number of rows and the share of entries that are not zero; the \
                 step, if it is not the first. In a matrix with more rows than the picture has cells, a cell is \
                 darker if more of its entries are nonzero. Perpendicular rods that share a point mass have no common \
                 entry."
            ),
            across: ACROSS,
            panels: some.iter().map(small).collect(),
        });
    }
}

fn title(figure: usize, figures: usize) -> String {
    let part = if figures > 1 { format!(", {figure} of {figures}") } else { String::new() };
    format!("A of the shipped scenes{part}")
}

fn note(picture: &Picture) -> String {
    let raster = &picture.raster;
    let step =
        if picture.step > 1 { format!(", step\u{a0}{}", picture.step) } else { String::new() };
    format!("{}², {}\u{a0}%{step}", count(raster.rows), readable(raster.fill(), 2))
}
