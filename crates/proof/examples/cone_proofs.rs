//! Writes proofs about random problems with friction cones, one JSON object a line with the keys
//! `problem` and `proof`: `cargo run -p lcplab-proof --example cone_proofs -- COUNT [SEED]`. Then
//! `tests/independent/cone_proofs.py` checks every claim without using the boxes.
//!
//! Each problem is made from a point: the states of its contacts are drawn, and b is computed from
//! x and w, in floating point. In a third of the problems the point violates its law, and the
//! answer is off by up to 1e-4. Some proofs are changed, or are about another b or another bias;
//! those that the checker accepts all the same are written, too.

use lcplab_lcp::file::Problem;
use lcplab_lcp::friction::Model;
use lcplab_lcp::{Coupling, Gauss, Lcp, Matrix, Question};
use lcplab_proof::{Kind, Proof, check, hash, prove, prove_kind};
use oorandom::Rand64;
use serde_json::json;

const INF: f64 = f64::INFINITY;

/// Random numbers.
struct Random(Rand64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0.rand_range(0..n as u64) as usize
    }

    fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.0.rand_float()
    }

    /// A size from 1e-8 to 1e8 in every fourth problem, near 1 otherwise.
    fn size(&mut self) -> f64 {
        let most = if self.below(4) == 0 { 8.0 } else { 1.0 };
        10.0_f64.powf(self.between(-most, most))
    }

    fn direction(&mut self) -> [f64; 2] {
        let angle = self.between(0.0, 6.3);
        [angle.cos(), angle.sin()]
    }

    /// x and w of a contact in a random state, which obey the law if `is_right`.
    fn contact(&mut self, law: Model, mu: f64, is_right: bool) -> [[f64; 3]; 2] {
        let (force, slip, [p, q]) = (self.size(), self.size(), self.direction());
        let lift = if law == Model::AssociatedCone { mu * slip } else { 0.0 };
        let sign = if is_right || self.below(2) == 0 { 1.0 } else { -1.0 };
        match self.below(4) {
            0 => [[0.0; 3], [sign * (lift + self.size()), slip * p, slip * q]],
            1 => {
                let part = mu * force * if is_right { self.between(0.0, 1.0) } else { 1.0 + 1e-9 };
                [[sign * force, part * p, part * q], [0.0; 3]]
            }
            _ => {
                let friction = -sign * mu * force;
                [[force, friction * p, friction * q], [lift, slip * p, slip * q]]
            }
        }
    }
}

/// A problem with its A, of one to three contacts, and the point that it was made from.
fn from_point(law: Model, random: &mut Random) -> (Problem, Vec<f64>) {
    let contacts = [1, 1, 1, 2, 3][random.below(5)];
    let (n, is_right) = (3 * contacts, random.below(3) > 0);
    let mu = random.between(0.05, 1.5);
    let scales: Vec<f64> = (0..n).map(|_| random.size()).collect();
    let is_diagonal = random.below(2) == 0;
    let mut a = vec![0.0; n * n];
    for i in 0..n {
        for j in 0..n {
            let part = if is_diagonal { 0.0 } else { random.between(-0.3, 0.3) / contacts as f64 };
            a[i * n + j] = if i == j { scales[i] } else { part * (scales[i] * scales[j]).sqrt() };
        }
        if is_diagonal && i % 3 == 2 {
            a[i * n + i] = a[(i - 1) * n + i - 1];
        }
    }
    let (mut x, mut w) = (Vec::new(), Vec::new());
    for _ in 0..contacts {
        let [own, slip] = random.contact(law, mu, is_right);
        x.extend(own);
        w.extend(slip);
    }
    let product = |i: usize| (0..n).map(|j| a[i * n + j] * x[j]).sum::<f64>();
    let b: Vec<f64> = (0..n).map(|i| w[i] - product(i)).collect();
    (posed(law, mu, &a, b, None), x)
}

fn posed(law: Model, mu: f64, a: &[f64], b: Vec<f64>, motion: Option<Gauss>) -> Problem {
    let n = b.len();
    let lo = (0..n).map(|i| if i % 3 == 0 { 0.0 } else { -INF }).collect();
    let lcp = Lcp::new(Matrix::dense(n, a), b, lo, vec![INF; n]).expect("a problem");
    let index = (0..n).map(|i| (i % 3 != 0).then_some(i - i % 3)).collect();
    let lcp = lcp.with_coupling(Coupling::new(index, vec![mu; n]).expect("friction"));
    Problem { model: Some(law), motion, ..Problem::new("numbers", lcp.expect("friction")) }
}

/// A body on two to four contacts with the same normal, at heights and in places that are dyadic or
/// not, so that the rows of J depend on each other exactly or only up to rounding; the point is one
/// of the forces that hold it.
fn on_contacts(law: Model, random: &mut Random) -> (Problem, Vec<f64>) {
    let (mu, mass) = (random.between(0.05, 1.5), random.size());
    let inertia = [0; 3].map(|_| random.size() * mass);
    let (slides, is_right) = (random.below(2) == 0, random.below(4) > 0);
    let (speed, [p, q]) = (random.between(0.5, 5.0), random.direction());
    let push =
        mu * speed * if slides { random.between(1.01, 3.0) } else { random.between(0.0, 0.99) };
    let push = if is_right { push } else { mu * speed };
    let brake = f64::min(1.0, mu * speed / push);
    let (a, b) = (random.between(0.2, 1.0), random.between(0.2, 1.0));
    let share = random.between(-0.9, 0.9) * if is_right { 1.0 } else { 1.2 };
    let corners = [(a, b, 1.0), (-a, b, -1.0), (a, -b, -1.0), (-a, -b, 1.0)];
    let noise = if random.below(6) == 0 { 1e-16 } else { 0.0 };
    let (mut jacobian, mut x) = (Vec::new(), Vec::new());
    for (r, s, sign) in corners {
        let quarter = mass / 4.0 * (1.0 + sign * share);
        jacobian.push(vec![(2, 1.0), (3, s * (1.0 + noise)), (4, -r)]);
        x.push(quarter * speed);
        let [c, d] = random.direction();
        for [c, d] in [[c, d], [-d, c]] {
            jacobian.push(vec![(0, c), (1, d), (5, r * d - s * c)]);
            x.push(-quarter * brake * push * (p * c + q * d));
        }
    }
    let weights: Vec<f64> = [mass; 3].into_iter().chain(inertia).collect();
    let target = vec![push * p, push * q, -speed, 0.0, 0.0, 0.0];
    let n = jacobian.len();
    let entry = |i: usize, j: usize| jacobian[i].iter().find(|e| e.0 == j).map_or(0.0, |e| e.1);
    let products =
        |i: usize, k: usize| (0..6).map(|j| entry(i, j) * entry(k, j) / weights[j]).sum();
    let full: Vec<f64> = (0..n * n).map(|k| products(k / n, k % n)).collect();
    let offset = [0.0, 0.0, 1e-15, 1e-3][random.below(4)];
    let mut bias = vec![0.0; n];
    bias[3 * random.below(4)] = offset;
    let b =
        (0..n).map(|i| (0..6).map(|j| entry(i, j) * target[j]).sum::<f64>() + bias[i]).collect();
    let motion = Gauss {
        mass: weights.iter().enumerate().map(|(i, &weight)| (i, i, weight)).collect(),
        jacobian,
        bias,
        compliance: vec![[0.0, 0.0, 1e-9, 0.1][random.below(4)]; n],
        target,
        lo: (0..n).map(|i| if i % 3 == 0 { 0.0 } else { -INF }).collect(),
        hi: vec![INF; n],
        level: None,
    };
    (posed(law, mu, &full, b, Some(motion)), x)
}

/// The same proof about a problem with one other number, or with one other digit.
fn changed(problem: &Problem, proof: &Proof, random: &mut Random) -> Option<(Problem, Proof)> {
    let by = 1.0 + [f64::EPSILON, 1e-12, 1e-9, 1e-3][random.below(4)];
    let mut other = problem.clone();
    match (random.below(3), &mut other.motion) {
        (0, _) => {
            let text = proof.to_json().to_string();
            let begin = text.find("\"kind\"").unwrap_or(0);
            let digits: Vec<usize> =
                (begin..text.len()).filter(|&k| text.as_bytes()[k].is_ascii_hexdigit()).collect();
            let mut bytes = text.into_bytes();
            bytes[digits[random.below(digits.len())]] = b"0123456789abcdef"[random.below(16)];
            let proof = Proof::parse(&String::from_utf8(bytes).ok()?, "changed").ok()?;
            return Some((other, proof));
        }
        (1, Some(motion)) => {
            let (i, j) = (random.below(motion.bias.len()), random.below(6));
            match random.below(4) {
                0 => motion.bias[i] += by - 1.0,
                1 => motion.target[j] *= by,
                2 => motion.mass[j].2 *= by,
                _ => motion.jacobian[i][0].1 *= by,
            }
        }
        _ => {
            let lcp = &problem.lcp;
            let mut b = lcp.b().to_vec();
            b[random.below(lcp.len())] *= by;
            let (lo, hi) = (lcp.lo().to_vec(), lcp.hi().to_vec());
            let changed = Lcp::new(lcp.matrix().clone(), b, lo, hi).ok()?;
            other.lcp = changed.with_coupling(lcp.coupling()?.clone()).ok()?;
        }
    }
    let problem = hash(&Question::new(&other, None, "changed").ok()?);
    Some((other, Proof { problem, ..proof.clone() }))
}

fn main() {
    let mut arguments = std::env::args().skip(1).map(|argument| argument.parse().ok());
    let count: u32 = arguments.next().flatten().unwrap_or(1000);
    let mut random = Random(Rand64::new(u128::from(arguments.next().flatten().unwrap_or(59_u32))));
    let (mut proofs, mut mutants, mut accepted) = (0, 0, 0);
    for k in 0..count {
        let law = [Model::CoulombCone, Model::AssociatedCone][random.below(2)];
        let (problem, mut x) = match k % 5 {
            0 => on_contacts(law, &mut random),
            _ => from_point(law, &mut random),
        };
        let off = [0.0, 0.0, 1e-15, 1e-12, 1e-8, 1e-4][random.below(6)];
        x.iter_mut().for_each(|x| *x *= 1.0 + off * random.between(-1.0, 1.0));
        let question = Question::new(&problem, None, "numbers").expect("a question");
        let found = match problem.motion {
            Some(_) => prove_kind(&question, &x, Kind::BodySolution),
            None => prove(&question, &x),
        };
        // A claim about the motion is checked for this problem only, whose motion is known.
        let of_motion = prove_kind(&question, &x, Kind::Motion).proof;
        if let Some(proof) = of_motion {
            println!("{}", json!({ "problem": problem.to_json(), "proof": proof.to_json() }));
            for _ in 0..5 {
                let Some((other, proof)) = changed(&problem, &proof, &mut random) else { continue };
                let other = Question::new(&other, None, "changed").expect("a question");
                let is_same = hash(&question) == hash(&other);
                if is_same && check(&question, &proof).is_ok() {
                    println!(
                        "{}",
                        json!({ "problem": problem.to_json(), "proof": proof.to_json() })
                    );
                }
            }
        }
        let Some(proof) = found.proof else { continue };
        proofs += 1;
        println!("{}", json!({ "problem": problem.to_json(), "proof": proof.to_json() }));
        for _ in 0..5 {
            let Some((other, proof)) = changed(&problem, &proof, &mut random) else { continue };
            let question = Question::new(&other, None, "changed").expect("a question");
            mutants += 1;
            if check(&question, &proof).is_ok() {
                accepted += 1;
                println!("{}", json!({ "problem": other.to_json(), "proof": proof.to_json() }));
            }
        }
    }
    eprintln!("{count} problems, {proofs} proofs; {mutants} changed ones, {accepted} accepted");
}
