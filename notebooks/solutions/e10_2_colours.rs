//! Exercise 10.2: colours for rows that may be done at once.
//!
//! Each row touches two bodies, given by number; `None` is the ground. Two rows that share a body must not be done
//! at the same time, or both would change its velocity; the ground has no velocity that changes. Give the rows
//! colours 0, 1, 2, …, so that rows of one colour share no body but the ground. Go through the rows in their order,
//! and give each the smallest colour that no earlier row has with which it shares a body.

/// The colour of each row.
pub fn answer(rows: &[[Option<usize>; 2]]) -> Vec<usize> {
    let mut colours: Vec<usize> = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        let shares = |j: usize| row.iter().flatten().any(|k| rows[j].contains(&Some(*k)));
        let taken: Vec<usize> = (0..i).filter(|&j| shares(j)).map(|j| colours[j]).collect();
        let mut colour = 0;
        while taken.contains(&colour) {
            colour += 1;
        }
        colours.push(colour);
    }
    colours
}
