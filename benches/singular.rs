//! What does an exact answer cost with redundant contacts, compared with clarabel?

mod contest;

use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use lcplab_benches::problems::Stack;

const SOLVERS: [&str; 4] = ["interior-point", "dantzig", "block-pivoting", "lemke"];

fn redundant(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("redundant contacts");
    group.sample_size(10).measurement_time(Duration::from_secs(1));
    for compliance in [0.0, 1e-8] {
        for friction in [0.0, 0.5] {
            for &boxes in contest::sizes(&[5, 10, 20, 50]) {
                let stack = Stack { boxes, friction, compliance };
                let lcp = stack.lcp().expect("a stack");
                contest::all(&mut group, &stack.name(), &lcp, 1e-9, &SOLVERS);
            }
        }
    }
}

criterion_group!(benches, redundant);
criterion_main!(benches);
