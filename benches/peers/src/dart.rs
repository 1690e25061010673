//! DART's Dantzig solver, from its Python wheel.
//!
//! The Python function of the wheel treats each array as one number, so it solves one row. But the
//! library exports the function, and this program calls it there, in the same process and with the
//! same clock as all others.

use std::os::raw::c_int;
use std::process::Command;
use std::sync::OnceLock;
use std::time::Instant;

use libloading::os::unix::{Library, RTLD_GLOBAL, RTLD_LAZY, RTLD_LOCAL};

use crate::contender::{Contender, Run};
use crate::raw::Raw;

/// The environment variable for the Python that has the wheel; the default is `python3`.
const PYTHON: &str = "PEERS_PYTHON";

/// Prints the version of the wheel, its library, and Python's own.
const WHERE: &str = "import importlib.metadata as m, importlib.util as u, os, sysconfig as s
print(m.version('dartpy')); print(u.find_spec('dartpy').origin)
print(os.path.join(s.get_config_var('LIBDIR'), s.get_config_var('INSTSONAME')))";

/// `bool dart::lcpsolver::dantzig::solveLcp<double>(n, A, x, b, w, nub, lo, hi, findex,
/// earlyTermination)`
const NAME: &[u8] = b"_ZN4dart9lcpsolver7dantzig8solveLcpIdEEbiPT_S4_S4_S4_iS4_S4_Pib";

type Solve = unsafe extern "C" fn(
    c_int,
    *mut f64,
    *mut f64,
    *mut f64,
    *mut f64,
    c_int,
    *mut f64,
    *mut f64,
    *mut c_int,
    bool,
) -> bool;

/// The function and the version, if the wheel is there.
struct Wheel {
    version: String,
    solve: Solve,
}

/// The version of the wheel.
pub fn version() -> Option<&'static str> {
    wheel().map(|wheel| wheel.version.as_str())
}

fn wheel() -> Option<&'static Wheel> {
    static WHEEL: OnceLock<Option<Wheel>> = OnceLock::new();
    WHEEL.get_or_init(load).as_ref()
}

fn load() -> Option<Wheel> {
    let python = std::env::var(PYTHON).unwrap_or_else(|_| "python3".into());
    let answer = Command::new(python).args(["-c", WHERE]).output().ok()?;
    let answer = String::from_utf8(answer.stdout).ok()?;
    let [version, wheel, interpreter] = answer.lines().collect::<Vec<_>>().try_into().ok()?;
    // SAFETY: both are libraries that Python loads in this order too; what they do when loaded
    // touches nothing of ours. They are never unloaded. The type is that of the name, which spells
    // all parameters.
    unsafe {
        std::mem::forget(Library::open(Some(interpreter), RTLD_LAZY | RTLD_GLOBAL).ok()?);
        let library = Library::open(Some(wheel), RTLD_LAZY | RTLD_LOCAL).ok()?;
        let solve = *library.get::<Solve>(NAME).ok()?;
        std::mem::forget(library);
        Some(Wheel { version: version.into(), solve })
    }
}

/// Its Dantzig solver.
pub fn solvers(raw: &Raw) -> Vec<Contender<'_>> {
    let contender = |wheel: &'static Wheel| {
        Contender::peer("DART Dantzig", move || {
            let mut own = raw.padded(4);
            let unbounded = if raw.is_unbounded() { own.n } else { 0 };
            let mut findex = vec![-1; raw.rows()];
            let (mut x, mut w) = (vec![0.0; raw.rows()], vec![0.0; raw.rows()]);
            let start = Instant::now();
            // SAFETY: rows of A begin every fourth number, all other arrays have n; it keeps no
            // pointer.
            let is_solved = unsafe {
                (wheel.solve)(
                    own.n,
                    own.a.as_mut_ptr(),
                    x.as_mut_ptr(),
                    own.b.as_mut_ptr(),
                    w.as_mut_ptr(),
                    unbounded,
                    own.lo.as_mut_ptr(),
                    own.hi.as_mut_ptr(),
                    findex.as_mut_ptr(),
                    false,
                )
            };
            let seconds = start.elapsed().as_secs_f64();
            let complaint = (!is_solved).then(|| "it said that it failed".into());
            Run { seconds, x, complaint }
        })
    };
    wheel().map(contender).into_iter().collect()
}
