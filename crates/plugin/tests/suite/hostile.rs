//! Six plug-ins that must not get through: none is accepted, each is named in a line, none is left
//! running.

use std::time::{Duration, Instant};

use lcplab_solver::Status;

use super::{LONG, Script, pushed, solve};

/// The reason why there is no answer.
fn reason(name: &str, answer: &str, limit: Duration) -> String {
    let script = Script::answering(name, answer);
    let plugin = script.start(limit);
    let (solution, certificate) = solve(&plugin, &pushed());
    let Status::NoAnswer { reason } = solution.status else { panic!("{:?}", solution.status) };
    assert!(!certificate.verdict.is_solution());
    assert!(!reason.contains('\n') && reason.len() < 300, "{reason}");
    reason
}

#[test]
fn one_with_a_false_claim_is_refuted() {
    let script = Script::answering("liar", "print('{\"x\": [7, 7]}', flush=True)");
    let plugin = script.start(LONG);
    let (solution, certificate) = solve(&plugin, &pushed());
    assert_eq!(solution.status, Status::Solved); // its word
    assert!(!certificate.verdict.is_solution());
}

#[test]
fn one_that_hangs_is_ended_with_its_children() {
    let script = Script::answering(
        "hangs",
        "open(sys.argv[0] + '.pid', 'w').write(str(subprocess.Popen(['sleep', '1000']).pid)); time.sleep(1000)",
    );
    let plugin = script.start(Duration::from_secs(2));
    let began = Instant::now();
    let (solution, _) = solve(&plugin, &pushed());
    assert_eq!(
        solution.status,
        Status::NoAnswer { reason: "no answer within its time limit of 2 s".into() }
    );
    assert!(began.elapsed() < LONG);
    let child = std::fs::read_to_string(script.path("hangs.py.pid")).unwrap();
    let stat = std::path::PathBuf::from(format!("/proc/{child}/stat"));
    let runs = || std::fs::read_to_string(&stat).is_ok_and(|stat| !stat.contains(") Z "));
    let waited = Instant::now();
    while runs() {
        assert!(waited.elapsed() < LONG, "its child is left running");
        std::thread::sleep(Duration::from_millis(10));
    }
}

#[test]
fn one_that_floods_the_pipe_is_ended() {
    let flood = "while True: sys.stdout.write('1' * 65536)";
    assert_eq!(reason("floods", flood, LONG), "its answer is longer than 640000 bytes");
    let lines = "sys.stdout.write('{\"x\": [0, 0]}\\n' * 1000); sys.stdout.flush()";
    assert_eq!(reason("chatters", lines, LONG), "it answers with more than one line");
    let complaints = "sys.stderr.write('oh\\n' * 1000000); sys.exit(3)";
    assert_eq!(reason("wails", complaints, LONG), "it ended (exit status: 3): oh");
}

#[test]
fn one_that_answers_nan_is_ended() {
    let nan = reason("nan", "print(json.dumps({'x': [float('nan'), 0]}), flush=True)", LONG);
    assert!(nan.starts_with("its answer is not JSON"), "{nan}");
    let word = reason("word", "print('{\"x\": [0, \"nan\"]}', flush=True)", LONG);
    assert_eq!(word, "x[1] is \"nan\", not a finite number");
}

#[test]
fn one_that_crashes_is_named_and_starts_again() {
    let script = Script::answering(
        "crashes",
        "print(json.dumps({'x': [0.5, 0] if p['b'][1] == 2 else [1 / 0]}), flush=True)",
    );
    let plugin = script.start(LONG);
    let mut other = pushed();
    other = lcplab_lcp::Lcp::new(
        other.matrix().clone(),
        vec![-1.0, 3.0],
        other.lo().to_vec(),
        other.hi().to_vec(),
    )
    .unwrap();
    let (solution, _) = solve(&plugin, &other);
    let words = "it ended (exit status: 1): ZeroDivisionError: division by zero";
    assert_eq!(solution.status, Status::NoAnswer { reason: words.into() });
    assert!(solve(&plugin, &pushed()).1.verdict.is_solution()); // the next problem finds it well
}

#[test]
fn one_with_the_wrong_number_of_entries_is_ended() {
    let short = reason("short", "print('{\"x\": [1]}', flush=True)", LONG);
    assert_eq!(short, "x has length 1, the problem has 2 rows");
}
