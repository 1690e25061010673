//! Friction problems under a model: solving, and judging an x, with results as JSON and as text.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::answer::{
    cell, claim, evidence_text, impossible, json_object, line, proof_of_denial, rounding,
    rounding_json,
};
use super::trial::Trial;
use lcplab_judge::{Demand, FrictionCertificate, Refutation, judge_cone, judge_friction};
use lcplab_lcp::file::{Problem, number};
use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law, Model, ProblemForm};
use lcplab_lcp::merit::RowTerms;
use lcplab_lcp::{Lcp, Question};
use lcplab_solver::{
    Method, Observer, Options, Reason, Registry, SequenceAnswer, Solution, Status,
    solve_by_sequence,
};

/// A contact slides if |w_t| is above this fraction of its terms.
const SLIP: f64 = 1e-6;
/// Maximum number of contacts that are printed.
const PRINTED: usize = 20;

/// The friction model: the requested one, otherwise the problem's own, otherwise Coulomb's law for
/// a solver that is made only for cones. `None` means that friction rows are treated as rows of a
/// boxed LCP.
pub fn model(
    asked: Option<Model>,
    solver: Option<&str>,
    problem: &Problem,
    solvers: &Registry,
) -> Option<Model> {
    let is_for_cones = |name: &&str| {
        solvers.entry(name).is_err() && solvers.method(name, Some(Model::CoulombCone)).is_ok()
    };
    let law = solver.filter(is_for_cones).map(|_| Model::CoulombCone);
    asked.or(problem.model).or(law)
}

/// Solves a problem under the model of the question and judges the answer.
pub fn solve(
    question: &Question,
    method: &Method,
    options: &Options,
    demand: &Demand,
    observer: &mut dyn Observer,
) -> (Solution, JudgedAnswer) {
    let solution = Trial::run(method, question.posed(), options, observer).solution;
    let judged = JudgedAnswer::of(question, &solution.x, demand);
    let judged = judged.with_claim(question.posed(), &solution.status, demand);
    (solution, judged.searched(question.posed(), demand))
}

/// Solves a problem under the model of the question by the fallback sequence, and judges the
/// answer.
pub fn solve_by_default(
    question: &Question,
    options: &Options,
    demand: &Demand,
    observer: &mut dyn Observer,
) -> (SequenceAnswer, JudgedAnswer) {
    let answered = solve_by_sequence(question.posed(), options, observer);
    let judged = JudgedAnswer::of(question, &answered.solution.x, demand);
    let judged = judged.with_claim(question.posed(), &answered.solution.status, demand);
    (answered, judged.searched(question.posed(), demand))
}

/// One contact in an answer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ContactAnswer {
    /// x_n, x_t1, x_t2.
    pub impulse: [f64; 3],
    /// w_n, w_t1, w_t2; (w_t1, w_t2) is the slip of a sliding contact.
    pub velocity: [f64; 3],
    /// |x_t| / (μ x_n): at most 1 within the disk; `None` if μ x_n = 0.
    pub strength: Option<f64>,
    /// The angle (degrees) between friction and the direction opposite to the slip; `None` if the
    /// contact does not slide, or has no friction.
    pub misalignment: Option<f64>,
}

/// The evaluation of an x, regardless of its source.
///
/// ```
/// use lcplab_analysis::friction::{JudgedAnswer, model, solve, solve_by_default};
/// use lcplab_judge::Demand;
/// use lcplab_lcp::Question;
/// use lcplab_lcp::file::Problem;
/// use lcplab_lcp::friction::Model;
/// use lcplab_solver::{Options, Registry, Status};
///
/// // A point of 1 kg reaches the ground with 2 m/s and slides along t1 with 3 m/s; μ = 0.5.
/// let text = r#"{"A": {"dense": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "b": [-2, -3, 0],
///                "friction_index": [-1, 0, 0], "mu": [0, 0.5, 0.5]}"#;
/// let problem = Problem::parse(text, "point.json")?;
/// // A solver that is made only for cones stands for Coulomb's law.
/// let registry = Registry::standard();
/// let law = model(None, Some("cone-pgs"), &problem, registry);
/// assert_eq!(law, Some(Model::CoulombCone));
/// let question = Question::new(&problem, Some(Model::CoulombCone), "point.json")?;
/// let (options, demand) = (Options::default(), Demand::default());
///
/// let method = registry.method("cone-pgs", question.model())?;
/// let (solution, judged) = solve(&question, method, &options, &demand, &mut ());
/// assert!(judged.certificate.verdict.is_solution());
/// assert_eq!(judged.claim(&solution.status, None).0, "solved");
/// let (_, by_sequence) = solve_by_default(&question, &options, &demand, &mut ());
/// assert!(by_sequence.certificate.verdict.is_solution());
///
/// // Too little friction: 2 m/s of slip remain, which need all of μ x_n = 1 N s.
/// let wrong = JudgedAnswer::of(&question, &[2.0, 0.5, 0.0], &demand);
/// let wrong = wrong.with_claim(question.posed(), &Status::Solved, &demand);
/// let wrong = wrong.searched(question.posed(), &demand); // a solution exists, so no proof
/// assert!(wrong.json().contains_key("contacts"));
/// assert!(wrong.text().starts_with("verdict    not a solution"));
/// let friction = question.friction().unwrap();
/// let same = JudgedAnswer::at_contacts(friction, question.posed(), &[2.0, 0.5, 0.0], &demand);
/// assert_eq!(same.certificate.verdict, wrong.certificate.verdict);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct JudgedAnswer {
    /// The judge's verdict on x as a solution of the model's own problem.
    pub certificate: FrictionCertificate,
    /// The contacts, one by one.
    pub contacts: Vec<ContactAnswer>,
    /// The scaled residual of x in Coulomb's law.
    pub coulomb_residual: f64,
}

impl JudgedAnswer {
    /// Judges an answer, one number per row of the problem, under the model of the question.
    /// Without contacts, Coulomb's law requires nothing beyond the problem.
    pub fn of(question: &Question, x: &[f64], demand: &Demand) -> Self {
        match question.friction() {
            Some(friction) => JudgedAnswer::at_contacts(friction, question.posed(), x, demand),
            None => {
                let certificate = judge_friction(question.posed(), x, demand);
                let coulomb_residual = certificate.scaled_residual;
                JudgedAnswer { certificate, contacts: Vec::new(), coulomb_residual }
            }
        }
    }

    /// Judges x under the model of the posed problem.
    pub fn at_contacts(
        problem: &FrictionProblem,
        posed: &ProblemForm,
        x: &[f64],
        demand: &Demand,
    ) -> Self {
        let coulomb = ConeProblem::new(problem.clone(), Law::Coulomb);
        let unproved = Demand { prove_up_to: 0, ..*demand };
        let certificate = judge_friction(posed, x, demand);
        let contact = |c: &Contact| contact(problem.lcp(), c, x, &certificate.w);
        JudgedAnswer {
            contacts: problem.contacts().iter().map(contact).collect(),
            certificate,
            coulomb_residual: judge_cone(&coulomb, x, &unproved).scaled_residual,
        }
    }

    /// The same with the judge's result on the solver's claim that there is no solution.
    pub fn with_claim(self, posed: &ProblemForm, status: &Status, demand: &Demand) -> Self {
        let proof = provable(posed).and_then(|lcp| proof_of_denial(lcp, status, demand));
        self.refuted_by(proof)
    }

    /// The same answer; if it is rejected, with a proof that no x solves the problem, where the
    /// judge finds one.
    pub fn searched(self, posed: &ProblemForm, demand: &Demand) -> Self {
        let FrictionCertificate { verdict, .. } = &self.certificate;
        let is_open = !verdict.is_solution() && self.certificate.refutation().is_none();
        let proof = provable(posed).and_then(|lcp| impossible(lcp, is_open, demand));
        self.refuted_by(proof)
    }

    fn refuted_by(self, proof: Option<Refutation>) -> Self {
        match proof {
            Some(proof) => JudgedAnswer { certificate: self.certificate.refuted_by(proof), ..self },
            None => self,
        }
    }

    /// The claim of the solver that gave this answer, as one of four words and as a sentence.
    pub fn claim(&self, status: &Status, stopped: Option<Reason>) -> (&'static str, String) {
        claim(status, &self.certificate.verdict, self.certificate.refutation(), stopped)
    }

    /// The judge's part of the JSON.
    pub fn json(&self) -> Map<String, Value> {
        let optional = |value: Option<f64>| value.map_or(Value::Null, number);
        let triple = |values: [f64; 3]| values.map(number);
        let contact = |c: &ContactAnswer| {
            json!({
                "impulse": triple(c.impulse),
                "velocity": triple(c.velocity),
                "strength": optional(c.strength),
                "misalignment": optional(c.misalignment),
            })
        };
        let mut object = Map::new();
        object.insert("w".into(), self.certificate.w.iter().map(|&w| number(w)).collect());
        object.insert("scaled_residual".into(), number(self.certificate.scaled_residual));
        object.insert("coulomb_residual".into(), number(self.coulomb_residual));
        object.extend(json_object(&self.certificate.verdict));
        object.extend(rounding_json(self.certificate.rounded_by));
        if let Some(evidence) = &self.certificate.evidence {
            object.insert("certificate".into(), json_object(evidence).into());
        }
        object.insert("contacts".into(), self.contacts.iter().map(contact).collect());
        object
    }

    /// The verdict, the residuals and the contacts as lines of text.
    pub fn text(&self) -> String {
        let FrictionCertificate { scaled_residual, verdict, .. } = &self.certificate;
        let mut text = format!(
            "verdict    {verdict}\n  scaled residual   {:>10}  under this model\n  \
             coulomb residual  {:>10}  of the same x under Coulomb's law\n",
            cell(*scaled_residual, 3),
            cell(self.coulomb_residual, 3)
        );
        text += &rounding(self.certificate.rounded_by).as_ref().map(line).unwrap_or_default();
        let evidence = self.certificate.evidence.as_ref();
        text += &evidence.map(|evidence| evidence_text(evidence, false)).unwrap_or_default();
        text += &format!(
            "{:>7} {:>14} {:>14} {:>14} {:>14} {:>10} {:>14}\n",
            "contact", "x_n", "|x_t|", "w_n", "|w_t|", "|x_t|/μx_n", "misaligned (°)"
        );
        for (k, contact) in self.contacts.iter().enumerate().take(PRINTED) {
            let ([x_n, x1, x2], [w_n, w1, w2]) = (contact.impulse, contact.velocity);
            let optional =
                |value: Option<f64>| value.map_or("–".to_string(), |value| cell(value, 3));
            text += &format!(
                "{k:>7} {:>14} {:>14} {:>14} {:>14} {:>10} {:>14}\n",
                cell(x_n, 6),
                cell(x1.hypot(x2), 6),
                cell(w_n, 6),
                cell(w1.hypot(w2), 6),
                optional(contact.strength),
                optional(contact.misalignment)
            );
        }
        if self.contacts.len() > PRINTED {
            let more = self.contacts.len() - PRINTED;
            text += &format!("        and {more} more contacts; the JSON output has all\n");
        }
        text
    }
}

/// Whether it can be proved that no x solves the problem.
pub(crate) fn is_impossible(posed: &ProblemForm, demand: &Demand) -> bool {
    provable(posed).and_then(|lcp| impossible(lcp, true, demand)).is_some()
}

/// The boxed problem of which it can be proved that it has no solution, if there is one.
fn provable(posed: &ProblemForm) -> Option<&Lcp> {
    match posed {
        ProblemForm::Boxed(lcp) => Some(lcp),
        // The directions of more corners are rounded numbers.
        ProblemForm::Polyhedral(polygon) if polygon.directions() == 4 => Some(polygon.lcp()),
        ProblemForm::Polyhedral(_) | ProblemForm::Cone(_) => None,
    }
}

fn contact(lcp: &Lcp, contact: &Contact, x: &[f64], w: &[f64]) -> ContactAnswer {
    let terms = contact.rows.map(|i| RowTerms::at(lcp, i, x));
    let (impulse, velocity) = (contact.of(x), contact.of(w));
    let [x_n, x1, x2] = impulse;
    let [_, w1, w2] = velocity;
    let limit = contact.mu * x_n;
    let size = |row: &RowTerms| libm::ldexp(row.magnitude, row.exponent);
    let slides = w1.hypot(w2) > SLIP * size(&terms[1]).hypot(size(&terms[2]));
    let angle = f64::atan2(x1 * w2 - x2 * w1, -(x1 * w1 + x2 * w2)).abs().to_degrees();
    ContactAnswer {
        impulse,
        velocity,
        strength: (limit > 0.0).then(|| x1.hypot(x2) / limit),
        misalignment: (slides && x1.hypot(x2) > 0.0).then_some(angle),
    }
}
