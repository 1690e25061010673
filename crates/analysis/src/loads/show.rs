//! Forces as text and as JSON.

use serde_json::{Value, json};

use super::{BodyLoad, ContactLoad, Loads, PairLoad, Range, Wrench};
use lcplab_lcp::file::number;
use lcplab_page::document::Section;
use lcplab_page::number::readable;

/// Significant digits.
const DIGITS: usize = 5;
/// Maximum number of contacts of a pair, and of pairs, that are printed.
const PRINTED: usize = 20;

impl Loads {
    /// The block of text that commands print.
    pub fn text(&self) -> String {
        let unit = self.unit;
        let ranges = match &self.unexamined {
            Some(why) => format!("no ranges: {why}"),
            None => "ranges: all forces that cause the same motion and obey the friction limits; unique: \
                     to a millionth of the largest force"
                .into(),
        };
        let mut text = format!("forces     {unit} in world axes\n  {ranges}\n");
        for pair in self.pairs.iter().take(PRINTED) {
            let by = if pair.by.is_empty() { "the world" } else { &pair.by };
            let force = vector(pair.wrench.force);
            text += &format!("  on {} by {by}: {force}, ", pair.on);
            text += &format!("{}\n", self.carried(pair));
            let moment = self.moment(pair.wrench);
            text += &format!("    moment {moment} {unit} m about the center of mass\n");
            for contact in pair.contacts.iter().take(PRINTED) {
                let value = readable(contact.value, DIGITS);
                let (force, arm) = (vector(contact.wrench.force), vector(contact.arm));
                text += &format!("    {}: {value} {unit}", contact.label);
                text += &self.range(contact.range);
                text += &format!("; with friction {force}, at {arm} m from the center of mass");
                text += "\n";
            }
            text += &more(pair.contacts.len(), "contacts");
        }
        text += &more(self.pairs.len(), "pairs");
        for body in self.bodies.iter().take(PRINTED) {
            text += &format!("  sum on {}: {}", body.name, vector(body.wrench.force));
            if let Some(weight) = body.weight {
                text += &format!(", weight {}", vector(weight));
            }
            text += "\n";
        }
        text + &more(self.bodies.len(), "bodies")
    }

    /// The moment; 0 for one that is only rounding of the forces' moments.
    fn moment(&self, wrench: Wrench) -> String {
        let arms = self.pairs.iter().flat_map(|pair| &pair.contacts).flat_map(|own| own.arm);
        let longest = arms.fold(0.0, |most: f64, arm| most.max(arm.abs()));
        let size = wrench.force.iter().fold(0.0, |most: f64, force| most.max(force.abs()));
        let cleaned = |m: f64| if m.abs() < 1e-9 * longest * size { 0.0 } else { m };
        vector(wrench.moment.map(cleaned))
    }

    /// The forces as a section of a document.
    pub fn section(&self) -> Section {
        let unit = self.unit;
        let mut section = Section::new("forces by body");
        section.say(match &self.unexamined {
            Some(why) => format!("Forces in world axes. The ranges are not examined: {why}."),
            None => "Forces in world axes. A range is the least and the largest value of all forces that \
                     cause the same motion and obey the friction limits; unique means that both agree to a \
                     millionth of the largest force. The least-norm answer has the smallest Σ x²."
                .into(),
        });
        let range = |range: Option<Range>| match range {
            None => String::new(),
            Some(range) if range.is_unique => "unique".into(),
            Some(range) => {
                let [least, most] = [range.least, range.most];
                format!("{} to {}", self.short(least), self.short(most))
            }
        };
        let least_norm = |range: Option<Range>| {
            range.map_or(String::new(), |range| self.short(range.least_norm))
        };
        let pair = |pair: &PairLoad| {
            let by = if pair.by.is_empty() { "the world" } else { &pair.by };
            vec![
                pair.on.clone(),
                by.to_string(),
                vector(pair.wrench.force),
                self.moment(pair.wrench),
                self.short(pair.carried),
                range(pair.range),
                least_norm(pair.range),
            ]
        };
        let against = format!("against gravity ({unit})");
        let columns =
            ["on", "by", &format!("force ({unit})"), &format!("moment ({unit} m)"), &against];
        let ranges = [&format!("range ({unit})"), &format!("least-norm ({unit})")];
        let all = [&columns[..], &ranges.map(String::as_str)].concat();
        section.table("forces between bodies", &all, self.pairs.iter().map(pair).collect());
        let contact = |contact: &ContactLoad| {
            vec![
                contact.label.clone(),
                self.short(contact.value),
                vector(contact.wrench.force),
                vector(contact.arm),
                range(contact.range),
                least_norm(contact.range),
            ]
        };
        let (normal, force) = (format!("normal ({unit})"), format!("with friction ({unit})"));
        let columns = ["contact", &normal, &force, "point from the center of mass (m)"];
        let all = [&columns[..], &ranges.map(String::as_str)].concat();
        let contacts: Vec<Vec<String>> =
            self.pairs.iter().flat_map(|pair| &pair.contacts).map(contact).collect();
        if !contacts.is_empty() {
            section.table("forces of contacts", &all, contacts);
        }
        let body = |body: &BodyLoad| {
            vec![
                body.name.clone(),
                vector(body.wrench.force),
                self.moment(body.wrench),
                body.weight.map_or(String::new(), vector),
            ]
        };
        let columns = [
            "body",
            &format!("force ({unit})"),
            &format!("moment ({unit} m)"),
            &format!("weight ({unit})"),
        ];
        section.table(
            "sum of all forces on a body",
            &columns,
            self.bodies.iter().map(body).collect(),
        );
        section
    }

    /// A number for a cell; 0 for rounding.
    fn short(&self, value: f64) -> String {
        readable(self.cleaned(value), DIGITS)
    }

    /// What a pair carries, as a part of the weight of its body if that is known.
    fn carried(&self, pair: &PairLoad) -> String {
        let value = readable(pair.carried, DIGITS);
        let weight = self.bodies.iter().find(|body| body.name == pair.on).and_then(|b| b.weight);
        let weight = weight.map(|w| w.iter().map(|w| w * w).sum::<f64>().sqrt());
        let what = match weight.filter(|weight| *weight > 0.0) {
            Some(weight) => {
                let share = readable(100.0 * pair.carried / weight, 3);
                format!("{value} {} against gravity, {share} % of its weight", self.unit)
            }
            None => format!("{value} {} in total", self.unit),
        };
        what + &self.range(pair.range)
    }

    /// The end of a line: the range of its force. Without any range, the first line has the reason.
    fn range(&self, range: Option<Range>) -> String {
        let Some(range) = range else {
            let is_reason_given = self.unexamined.is_some();
            return if is_reason_given { String::new() } else { "; range not found".into() };
        };
        if range.is_unique {
            return "; unique".into();
        }
        let [least, most, least_norm] =
            [range.least, range.most, range.least_norm].map(|v| readable(self.cleaned(v), DIGITS));
        format!(
            "; {least} to {most} {}, {least_norm} {} in the least-norm answer",
            self.unit, self.unit
        )
    }

    /// 0 for a value that is only the rounding error of a linear program.
    fn cleaned(&self, value: f64) -> f64 {
        let forces = self.pairs.iter().flat_map(|pair| pair.wrench.force);
        let size = forces.fold(0.0, |most: f64, force| most.max(force.abs()));
        if value.abs() < 1e-6 * size { 0.0 } else { value }
    }

    /// The key `loads` of an answer.
    pub fn json(&self) -> Value {
        let numbers = |v: [f64; 3]| -> Value { v.iter().map(|&v| number(v)).collect() };
        let wrench = |w: &Wrench| json!({ "force": numbers(w.force), "moment": numbers(w.moment) });
        let range = |range: Option<Range>| {
            range.map(|range| {
                json!({
                    "least": number(range.least), "most": number(range.most),
                    "least_norm": number(range.least_norm), "is_unique": range.is_unique,
                })
            })
        };
        let contact = |contact: &ContactLoad| {
            json!({
                "label": contact.label, "value": number(contact.value),
                "wrench": wrench(&contact.wrench), "arm": numbers(contact.arm),
                "range": range(contact.range),
            })
        };
        let pair = |pair: &PairLoad| {
            let contacts: Vec<Value> = pair.contacts.iter().map(contact).collect();
            json!({
                "by": pair.by, "on": pair.on, "wrench": wrench(&pair.wrench),
                "carried": number(pair.carried), "range": range(pair.range),
                "contacts": contacts,
            })
        };
        let pairs: Vec<Value> = self.pairs.iter().map(pair).collect();
        let bodies: Vec<Value> = self
            .bodies
            .iter()
            .map(|body| {
                json!({
                    "name": body.name, "wrench": wrench(&body.wrench),
                    "weight": body.weight.map(numbers),
                })
            })
            .collect();
        json!({
            "unit": self.unit, "pairs": pairs, "bodies": bodies, "unexamined": self.unexamined,
        })
    }
}

fn vector(v: [f64; 3]) -> String {
    let size = v.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
    // Rounding of a sum.
    let entry = |v: f64| readable(if v.abs() < 1e-9 * size { 0.0 } else { v }, DIGITS);
    format!("({})", v.map(entry).join(", "))
}

fn more(count: usize, what: &str) -> String {
    match count.checked_sub(PRINTED) {
        Some(more @ 1..) => format!("    {more} more {what} are in the JSON output\n"),
        _ => String::new(),
    }
}
