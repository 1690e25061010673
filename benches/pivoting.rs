//! What does pivoting cost on the redundant contacts of a tower of cubes, four contacts each?

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use lcplab::lcp::Lcp;
use lcplab::scene::Scene;
use lcplab::simulation::Simulation;
use lcplab::solver::{Options, Registry, Settings, Start, Status};

fn options() -> Options {
    let settings = Settings::default().with_tolerance(1e-10);
    Options::default().with_settings(settings)
}

/// The LCP of the third step.
fn tower(count: usize, mu: f64) -> Lcp {
    let text = format!(
        "generate = {{ kind = \"stack\", count = {count}, size = 1, mass = 1 }}\n\
         [contact]\nfriction = {mu}\n\
         [[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n"
    );
    let scene = Scene::from_toml("tower.toml", &text).expect("a scene");
    let dantzig = Registry::standard().entry("dantzig").expect("a solver").build(&options());
    let mut simulation = Simulation::new(scene, dantzig);
    let steps: Vec<_> = (0..3).map(|_| simulation.step().expect("a step")).collect();
    steps[2].solves[0].problem.lcp.clone()
}

fn pivoting(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("pivoting a tower");
    group.sample_size(10);
    for (name, mu) in [("dantzig", 0.0), ("lemke", 0.0), ("dantzig", 0.5)] {
        let solver = Registry::standard().entry(name).expect("a solver").build(&options());
        for count in [15, 75] {
            let lcp = tower(count, mu);
            let solve = || solver.solve(black_box(&lcp), &Start::default(), &mut ());
            assert_eq!(solve().status, Status::Solved, "the problem must be solved");
            let id = BenchmarkId::new(format!("{name}, friction {mu}"), 4 * count);
            group.bench_function(id, |bencher| bencher.iter(solve));
        }
    }
}

criterion_group!(benches, pivoting);
criterion_main!(benches);
