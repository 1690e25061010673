//! A click on a head sorts the rows by the numbers behind the text.

use serde_json::json;

use super::sample;

#[test]
fn rows_are_sorted_by_number_and_by_name_both_ways() {
    let seen = sample().seen(
        1280,
        "const table = find('#table-1 table'), heads = [...table.tHead.rows[0].cells];
        const names = () => [...table.tBodies[0].rows].map((row) => row.cells[0].textContent);
        const sorts = () => heads.map((head) => head.getAttribute('aria-sort'));
        const look = () => [names(), sorts()], views = [look()];
        for (const k of [1, 1, 0]) { find('[role=button]', heads[k]).click(); views.push(look()); }
        press(find('[role=button]', heads[0]), 'Enter');
        return [...views, look()];",
    );
    let [none, up, down] = [json!(null), json!("ascending"), json!("descending")];
    assert_eq!(
        seen,
        json!([
            [["ten", "a third", "million", "minus nothing"], [none, none]],
            [["minus nothing", "a third", "ten", "million"], [none, up]],
            [["million", "ten", "a third", "minus nothing"], [none, down]],
            [["a third", "million", "minus nothing", "ten"], [up, none]],
            [["ten", "minus nothing", "million", "a third"], [down, none]],
        ])
    );
}
