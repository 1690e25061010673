//! Forces as text and as JSON.

use serde_json::{Value, json};

use super::{ContactLoad, Loads, PairLoad, Range, Wrench};
use lcplab_lcp::file::number;
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
            for contact in pair.contacts.iter().take(PRINTED) {
                let value = readable(contact.value, DIGITS);
                text += &format!("    {}: {value} {unit}", contact.label);
                text += &self.range(contact.range);
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
