//! Steps from problem files with the key `motion`, and answers.

use serde_json::Value;

use super::step::{EngineAnswer, EngineStep, FrictionRows, RowNames, Source};
use lcplab_lcp::error::{Defects, Result};
use lcplab_lcp::file::as_number;
use lcplab_lcp::friction::Model;
use lcplab_lcp::{Gauss, Level};

type Entries = Vec<(usize, usize, f64)>;

impl EngineStep {
    /// The step of a problem file and of an answer: the object of an answer file with the keys `x`,
    /// optionally `motion` (the engine's new motion v) and `reported_push`. Without `motion`, v is
    /// that of the forces. A and b are not read: they follow from the key `motion` of the problem.
    ///
    /// Numbers that are not finite are no defect: they reject the step.
    ///
    /// # Errors
    /// If a key is missing or has another form or length; all such keys are listed.
    pub fn read(problem: &Value, answer: &Value, input: &str) -> Result<EngineStep> {
        let mut reader = Reader { defects: Defects::default() };
        let step = reader.step(problem, answer);
        reader.defects.into_result(input)?;
        step.check(input)?;
        let has_motion = answer.get("motion").is_some();
        Ok(if has_motion { step } else { step.with_motion_of_forces() })
    }
}

/// Reads keys and collects their defects.
struct Reader {
    defects: Defects,
}

impl Reader {
    fn step(&mut self, problem: &Value, answer: &Value) -> EngineStep {
        let Some(motion) = problem.get("motion").filter(|motion| motion.is_object()) else {
            let reason = "is missing; it states the masses and rows that the check needs";
            self.defects.add("motion", reason);
            return EngineStep::default();
        };
        let bias = self.vector(motion, "motion.bias");
        let target = self.vector(motion, "motion.target");
        // They give the sizes for all other keys.
        if !self.defects.is_empty() {
            return EngineStep::default();
        }
        let (n, k) = (bias.len(), target.len());
        let mass = self.entries(motion, "motion.mass", (k, k));
        if mass.iter().any(|(i, j, _)| i > j) {
            self.defects.add("motion.mass", "has an entry below the diagonal");
        }
        let mut jacobian = vec![Vec::new(); n];
        for (i, j, value) in self.entries(motion, "motion.jacobian", (n, k)) {
            jacobian[i].push((j, value));
        }
        let forces = self.vector(answer, "x");
        let moved = match answer.get("motion") {
            Some(_) => self.vector(answer, "motion"),
            None => target.clone(),
        };
        let reported_push =
            answer.get("reported_push").map(|_| self.vector(answer, "reported_push"));
        let bounds = |reader: &mut Self, key: &str, otherwise: f64| match problem.get(key) {
            Some(_) => reader.vector(problem, key),
            None => vec![otherwise; n],
        };
        let gauss = Gauss {
            mass,
            jacobian,
            bias,
            compliance: self.vector(motion, "motion.compliance"),
            target,
            lo: bounds(self, "lo", 0.0),
            hi: bounds(self, "hi", f64::INFINITY),
            level: self.level(motion),
        };
        let friction = FrictionRows {
            index: self.index(problem, n),
            mu: bounds(self, "mu", 0.0),
            model: self.model(problem),
        };
        let mut source = self.source(problem);
        if source.name.is_empty() {
            let name = problem.get("name").and_then(Value::as_str);
            source.name = name.unwrap_or_default().into();
        }
        EngineStep {
            source,
            gauss,
            friction,
            answer: EngineAnswer { forces, motion: moved, reported_push },
            rows: self.rows(problem),
            ..EngineStep::default()
        }
    }

    /// The numbers under a key; the last part of the name is the key.
    fn vector(&mut self, object: &Value, name: &str) -> Vec<f64> {
        let key = name.rsplit('.').next().unwrap_or(name);
        let Some(value) = object.get(key) else {
            self.defects.add(name, "is missing");
            return Vec::new();
        };
        let values = value.as_array().map(|values| values.iter().map(as_number).collect());
        let values: Option<Option<Vec<f64>>> = values;
        values.flatten().unwrap_or_else(|| {
            self.defects.add(name, "must be a list of numbers");
            Vec::new()
        })
    }

    /// The entries of a matrix of this size, as row, column, value.
    fn entries(&mut self, object: &Value, name: &str, (rows, columns): (usize, usize)) -> Entries {
        let key = name.rsplit('.').next().unwrap_or(name);
        let Some(value) = object.get(key) else {
            self.defects.add(name, "is missing");
            return Vec::new();
        };
        let place = |value: &Value, size: usize| {
            value.as_u64().and_then(|at| usize::try_from(at).ok()).filter(|&at| at < size)
        };
        let entry = |value: &Value| match value.as_array()?.as_slice() {
            [i, j, value] => Some((place(i, rows)?, place(j, columns)?, as_number(value)?)),
            _ => None,
        };
        let entries: Option<Option<Entries>> =
            value.as_array().map(|values| values.iter().map(entry).collect());
        entries.flatten().unwrap_or_else(|| {
            let reason =
                format!("must be a list of [row, column, value] within {rows} × {columns}");
            self.defects.add(name, reason);
            Vec::new()
        })
    }

    fn index(&mut self, problem: &Value, n: usize) -> Vec<Option<usize>> {
        let Some(value) = problem.get("friction_index") else { return vec![None; n] };
        let index = |value: &Value| match value.as_i64()? {
            -1 => Some(None),
            normal => usize::try_from(normal).ok().map(Some),
        };
        let indices: Option<Option<Vec<_>>> =
            value.as_array().map(|values| values.iter().map(index).collect());
        indices.flatten().unwrap_or_else(|| {
            self.defects.add("friction_index", "must be a list of row indices, -1 for none");
            Vec::new()
        })
    }

    fn model(&mut self, problem: &Value) -> Option<Model> {
        let value = problem.get("model").filter(|value| !value.is_null())?;
        let model = value.as_str().and_then(|name| name.parse::<Model>().ok());
        let known = [Model::AssociatedCone, Model::CoulombCone, Model::CoupledBox];
        match model.filter(|model| known.contains(model)) {
            Some(Model::CoupledBox) => None,
            Some(model) => Some(model),
            None => {
                let known = known.map(|model| model.to_string()).join(", ");
                self.defects.add("model", format!("is {value}, must be one of {known}"));
                None
            }
        }
    }

    fn level(&mut self, motion: &Value) -> Option<Level> {
        let Some(value) = motion.get("level") else { return Some(Level::Velocity) };
        let level = Level::ALL.into_iter().find(|level| value.as_str() == Some(level.name()));
        if level.is_none() {
            let reason = format!("is {value}, must be \"velocity\" or \"acceleration\"");
            self.defects.add("motion.level", reason);
        }
        level
    }

    fn source(&mut self, problem: &Value) -> Source {
        let Some(source) = problem.get("source").filter(|source| source.is_object()) else {
            return Source::default();
        };
        serde_json::from_value(source.clone()).unwrap_or_else(|cause| {
            self.defects.add("source", cause.to_string());
            Source::default()
        })
    }

    fn rows(&mut self, problem: &Value) -> Vec<RowNames> {
        let Some(rows) = problem.get("rows") else { return Vec::new() };
        serde_json::from_value(rows.clone()).unwrap_or_else(|cause| {
            self.defects.add("rows", cause.to_string());
            Vec::new()
        })
    }
}

/// The answer that a problem file contains under the key `answer`.
pub fn answer_of(problem: &Value) -> Option<&Value> {
    problem.get("answer").filter(|answer| answer.is_object())
}
