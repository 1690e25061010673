//! Answers the questions of standard input, one a line, as the module in a page does.

fn main() {
    for question in std::io::stdin().lines() {
        println!("{}", lcplab_live::answer(&question.expect("text")));
    }
}
