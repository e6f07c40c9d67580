/* SPDX-License-Identifier: MIT
 *
 * The cells of a tile that have one size, and the sets of waves that they see.
 */
struct Job {
    int tile;
    ivec2 halvings; /* across and down */
    int kind;       /* leaf_class(): CELLS_… */
};

Job job_at(int place)
{
    int at = cells_data.jobs_at + JOB_WORDS * place;
    int how = int(state[at + 1]);
    return Job(int(state[at]), ivec2(how & 255, how >> 8 & 255), how >> 16);
}

/* Number of a class's first set. Each class has a set for each piece of the shutter. The sets of points come last. */
int first_set(int kind)
{
    int sets = 0;
    for (int k = 0; k < kind; k++)
        sets += parts_of_class(k);
    return sets;
}

int set_of_part(int kind) { return first_set(kind) + cells_data.part; }
int set_of_instant() { return first_set(CELL_CLASSES) + cells_data.instant; }
