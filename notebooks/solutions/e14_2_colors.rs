//! Exercise 14.2: colors for rows that may be done at once.
//!
//! Each row touches two bodies, given by number; `None` is the ground. Two rows that share a body
//! must not be done at the same time, or both would change its velocity; the ground has no velocity
//! that changes. Give the rows colors 0, 1, 2, …, so that rows of one color share no body but the
//! ground. Go through the rows in their order, and give each the smallest color that no earlier row
//! has with which it shares a body.

/// The color of each row.
pub fn answer(rows: &[[Option<usize>; 2]]) -> Vec<usize> {
    let mut colors: Vec<usize> = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        let shares = |j: usize| row.iter().flatten().any(|k| rows[j].contains(&Some(*k)));
        let taken: Vec<usize> = (0..i).filter(|&j| shares(j)).map(|j| colors[j]).collect();
        let mut color = 0;
        while taken.contains(&color) {
            color += 1;
        }
        colors.push(color);
    }
    colors
}
