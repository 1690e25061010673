//! What the chapter says of storages, beside what was measured.

use serde::{Deserialize, Serialize};

use super::memory::Memory;
use super::structure::Structure;
use crate::error::Result;
use crate::number::{count, readable};
use crate::storage::{CompressedRows, Dense, Entry, LinkedList, MapOfMaps, Storage};

/// A claim and what became of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Claim {
    /// What is claimed, in our words.
    pub says: String,
    /// What was found.
    pub found: String,
    /// What is said of it.
    pub verdict: Verdict,
    /// The erratum; empty if there is none.
    pub erratum: String,
}

/// What is said of a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Verdict {
    /// It holds.
    Confirmed,
    /// It holds with a condition that is not stated.
    Conditional,
    /// It does not hold.
    Wrong,
}

impl Claim {
    /// Whether it holds as it stands.
    pub fn holds(&self) -> bool {
        self.verdict == Verdict::Confirmed
    }
}

/// Bytes of the chapter's number and of its list entry.
const FLOAT: usize = 4;
const ENTRY: usize = 28;

/// Checks all claims; those about the net and the tower if those scenes were measured.
pub(super) fn run(memory: &[Memory], structures: &[Structure]) -> Result<Vec<Claim>> {
    let mut claims = vec![dense(), empty()?];
    claims.extend(full_list());
    claims.push(names()?);
    claims.push(zeros()?);
    claims.extend(memory.iter().find(|m| m.storage == "map of maps").map(map));
    claims.extend(structures.iter().find(|s| s.scene == "net").map(net));
    claims.extend(structures.iter().find(|s| s.scene == "tower").map(tower));
    claims.push(limits());
    Ok(claims)
}

fn claim(says: &str, found: String, verdict: Verdict, erratum: &str) -> Claim {
    Claim { says: says.into(), found, verdict, erratum: erratum.into() }
}

fn dense() -> Claim {
    let ours = Dense::new(100, 100).bytes();
    let found = format!("{} bytes of float; {} of f64", count(100 * 100 * FLOAT), count(ours));
    let verdict = if 100 * 100 * FLOAT == 40_000 { Verdict::Confirmed } else { Verdict::Wrong };
    claim("a dense 100 × 100 matrix takes about 40,000 bytes", found, verdict, "")
}

fn empty() -> Result<Claim> {
    let [mut small, mut large] = [LinkedList::new(1, 1), LinkedList::new(1_000_000, 1_000_000)];
    small.load(&[])?;
    large.load(&[])?;
    let heap = small.bytes() + large.bytes();
    let found = format!(
        "whatever its size, yes: {heap} bytes on the heap and {} of its own; 12 are three fields of 4 bytes, as \
         in a program of 32 bits",
        size_of::<LinkedList>()
    );
    let verdict = if heap == 0 { Verdict::Conditional } else { Verdict::Wrong };
    Ok(claim("an empty list takes as little as 12 bytes, whatever its size", found, verdict, ""))
}

fn full_list() -> [Claim; 3] {
    let (all, dense) = (100 * 100, 100 * 100 * FLOAT);
    let ours = LinkedList::BYTES_AN_ENTRY;
    let full = format!(
        "{} entries of {ENTRY} bytes: {}; of ours, {ours} bytes: {}",
        count(all),
        count(all * ENTRY),
        count(all * ours)
    );
    let ratio = format!(
        "{} : {} = {}:1 (28 is bytes an entry); ours {}:1",
        count(all * ENTRY),
        count(dense),
        all * ENTRY / dense,
        ours / size_of::<f64>()
    );
    let half = format!(
        "{} bytes; 70,000 are a quarter. Break-even at {} % fill",
        count(all / 2 * ENTRY),
        readable(100.0 * FLOAT as f64 / ENTRY as f64, 3)
    );
    [
        claim("a full 100 × 100 list takes about 280,000 bytes", full, Verdict::Confirmed, ""),
        claim("that is 28 times the dense matrix", ratio, Verdict::Wrong, "E57"),
        claim("a half full list takes about 70,000 bytes", half, Verdict::Wrong, "E57"),
    ]
}

fn names() -> Result<Claim> {
    let entries: Vec<Entry> = (0..100).map(|i| (i, i, 1.0)).collect();
    let (mut map, mut rows) = (MapOfMaps::new(100, 100), CompressedRows::new(100, 100));
    map.load(&entries)?;
    rows.load(&entries)?;
    let found = format!(
        "100 entries, one a row: {} bytes in {} pieces; compressed rows {} bytes in 3. MATLAB \
         compresses columns",
        count(map.bytes()),
        map.allocations(),
        count(rows.bytes())
    );
    let says = "the map of maps is based on compressed rows, as MATLAB's";
    Ok(claim(says, found, Verdict::Wrong, "E56"))
}

fn zeros() -> Result<Claim> {
    let numbers: Vec<f64> = (0..10_000).map(|k| f64::from(u8::from(k % 101 == 0))).collect();
    let kept = MapOfMaps::from_rows(100, 100, &numbers)?.stored();
    let found = format!(
        "as printed, the identity of 100 read from data keeps {} entries; with zeros dropped {kept}",
        count(numbers.len())
    );
    Ok(claim("the map keeps only what is not zero", found, Verdict::Wrong, "E54"))
}

fn map(map: &Memory) -> Claim {
    let bytes = readable(map.bytes_an_entry, 3);
    let found = match map.break_even {
        Some(fill) => {
            format!(
                "up to a fill of {} % at random places; {bytes} bytes an entry at 10 %",
                readable(fill, 3)
            )
        }
        None => format!("at every fill: {bytes} bytes an entry at 10 %"),
    };
    claim(
        "the map takes less memory than the dense matrix (the chapter's Table 1)",
        found,
        Verdict::Conditional,
        "",
    )
}

/// The fill (%) of A for a net of k × k free points joined by rods, by counting: E rods, and each point
/// with d rods couples d (d − 1) pairs.
fn net_fill(k: usize) -> f64 {
    let rods = 2 * k * (k - 1);
    let pairs = 4 * 2 + 4 * (k - 2) * 6 + (k - 2) * (k - 2) * 12;
    100.0 * (rods + pairs) as f64 / (rods as f64).powi(2)
}

fn net(net: &Structure) -> Claim {
    let below = (2..100).find(|&k| net_fill(k) < 1.0).unwrap_or(0);
    let found = format!(
        "{} % of {} rows in the scene net. By counting all pairs of rods that meet: {} % at 20 × 20 points, and \
         below 1 % from {below} × {below} on ({} %); where rods meet at right angles, the entry is 0",
        readable(net.fill, 3),
        count(net.rows),
        readable(net_fill(20), 2),
        readable(net_fill(below), 2)
    );
    let verdict = if net.fill < 1.0 { Verdict::Confirmed } else { Verdict::Wrong };
    claim("less than 1 % of the net's matrix is filled", found, verdict, "")
}

fn tower(tower: &Structure) -> Claim {
    // 700 cubes with a quaternion each: S is 4900 × 4200.
    let s = 7 * 700 * 6 * 700 * FLOAT;
    let of = |name: &str| {
        tower.bytes.iter().find(|(storage, _)| storage == name).map_or([0; 3], |(_, bytes)| *bytes)
    };
    let mega = |bytes: usize| readable(bytes as f64 / 1e6, 3);
    let ([_, _, dense], [_, _, rows]) = (of("dense"), of("compressed rows"));
    let found = format!(
        "kept dense, as in Code 8, S alone takes {} MB, M⁻¹ {} MB. Our tower has {} rows: dense A {} MB, \
         compressed {} MB",
        mega(s),
        mega(6 * 700 * 6 * 700 * FLOAT),
        count(tower.rows),
        mega(dense),
        mega(rows)
    );
    claim("a tower of 700 cubes runs in the demo", found, Verdict::Conditional, "E50")
}

fn limits() -> Claim {
    let bodies = |limit: usize| (limit - 1) / 7; // 7 rows of S a body
    let found = format!(
        "a body has 7 rows of S, the matrix that turns velocities into rates: scenes of more than {} and {} bodies stop",
        bodies(500),
        bodies(1501)
    );
    claim(
        "a matrix of 500 (Code 10) or 1501 (Code 11) rows or more signals a fault",
        found,
        Verdict::Wrong,
        "E50",
    )
}
