mod inverse_rows;
mod rank_one;
mod rows;
mod table;
mod terms;
