use lcplab::lesson::exercise::{Verdict, lesson10};

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // Column by column, as Code 11 reads its data (E53).
        ("10.1", lesson10::place(|row, column, rows, _| row + column * rows)),
        ("10.1", lesson10::place(|row, column, rows, _| row * rows + column)),
        (
            "10.2",
            lesson10::compressed_rows(|starts, columns, values, x| {
                // The place of the entry instead of its column.
                let row = |i: usize| {
                    (starts[i]..starts[i + 1])
                        .map(|k| values[k] * x[k % columns.len().min(x.len())])
                };
                (0..starts.len() - 1).map(|i| row(i).sum()).collect()
            }),
        ),
        (
            "10.2",
            lesson10::compressed_rows(|starts, columns, values, x| {
                // starts is taken for the number of rows.
                let of = |i: usize| {
                    let end = starts.get(i + 1).copied().unwrap_or(values.len());
                    (starts[i]..end).map(|k| values[k] * x[columns[k]]).sum()
                };
                (0..starts.len()).map(of).collect()
            }),
        ),
        // The ground joins all that stand on it.
        (
            "10.3",
            lesson10::pattern(|rows| {
                let share = |a: &[Option<usize>; 2], b: &[Option<usize>; 2]| {
                    a.iter().any(|body| b.contains(body))
                };
                rows.iter().map(|a| rows.iter().filter(|b| share(a, b)).count()).sum()
            }),
        ),
        // Every row meets its neighbours in the list, as in a chain.
        ("10.3", lesson10::pattern(|rows| 3 * rows.len() - 2)),
    ]
}
