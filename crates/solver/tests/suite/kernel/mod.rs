mod panels;
mod rank_one;
mod rows;
mod table;
mod terms;
