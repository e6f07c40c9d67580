// SPDX-License-Identifier: MIT
// Job type of Flamenco: renders frames by brute force, each by many machines. Tasks render parts of a frame's samples, and one behind them makes the picture.
// Copy it into the folder "scripts" beside flamenco-manager. Parts that are there are kept, and one that was killed goes on from its checkpoint.
const JOB_TYPE = {
    label: "Mangata Render in Parts",
    settings: [
        { key: "scene", type: "string", subtype: "file_path", required: true, description: "Scene file" },
        { key: "frames", type: "string", required: true, default: "0", description: "Frames, as in 7 or 0-59 or 0,8,16" },
        { key: "parts", type: "int32", default: 16, description: "Into how many parts the samples of each frame are cut" },
        { key: "parts_folder", type: "string", subtype: "dir_path", required: true, description: "Folder of the parts, which exists" },
        { key: "folder", type: "string", subtype: "dir_path", required: true, description: "Folder of the pictures, which exists" },
        { key: "file_name", type: "string", default: "frame_####.exr", description: "Their name with the place of the frame number" },
        { key: "options", type: "string", default: "--method reference", description: "Options of parts and pictures alike, separated by spaces" },
        { key: "picture_options", type: "string", default: "", description: "More options of the pictures alone, such as --layer all" },
        { key: "checkpoint", type: "int32", default: 300, description: "Seconds between the checkpoints of a part" },
        { key: "command", type: "string", default: "mangata", description: "The command" },
    ],
};

const words = (text) => (text || "").split(" ").filter((word) => word.length > 0);

function makeTask(job, name, args) {
    const task = author.Task(name, "misc");
    task.addCommand(author.Command("exec", { exe: job.settings.command, args: args.concat(["--skip-existing", "--progress", "text"]) }));
    return task;
}

function compileJob(job) {
    const s = job.settings;
    const options = words(s.options);
    for (const frame of frameChunker(s.frames, 1)) {
        const files = [], tasks = [];
        for (let i = 0; i < s.parts; i++) {
            files.push(`${s.parts_folder}/${frame}_${i}-of-${s.parts}.sums`);
            const place = ["--frames", frame, "--samples-range", `${i}/${s.parts}`, "--checkpoint", `${s.checkpoint}`];
            tasks.push(makeTask(job, `part-${frame}-${i}`, ["render", s.scene, "-o", files[i]].concat(place, options)));
        }
        const picture = ["-o", `${s.folder}/${s.file_name}`, "--frames", frame];
        const merge = makeTask(job, `merge-${frame}`, ["merge", s.scene].concat(files, picture, options, words(s.picture_options)));
        for (const task of tasks) {
            job.addTask(task);
            merge.addDependency(task);
        }
        job.addTask(merge);
    }
}
