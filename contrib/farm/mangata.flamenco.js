// SPDX-License-Identifier: MIT
// Job type of Flamenco: renders the frames of a scene, a chunk a task. Copy it into the folder "scripts" beside flamenco-manager.
// A frame that is there is kept, so that a task that another worker starts again goes on.
const JOB_TYPE = {
    label: "Mangata Render",
    settings: [
        { key: "scene", type: "string", subtype: "file_path", required: true, description: "Scene file" },
        { key: "frames", type: "string", required: true, default: "0-59", description: "Frames, as in 0-59 or 0,8,16" },
        { key: "chunk_size", type: "int32", default: 8, description: "Frames that one task renders" },
        { key: "folder", type: "string", subtype: "dir_path", required: true, description: "Folder of the pictures, which exists" },
        { key: "file_name", type: "string", default: "frame_####.exr", description: "Their name with the place of the frame number" },
        { key: "options", type: "string", default: "", description: "More options of mangata render, separated by spaces" },
        { key: "command", type: "string", default: "mangata", description: "The command" },
    ],
};

function compileJob(job) {
    const s = job.settings;
    const options = (s.options || "").split(" ").filter((word) => word.length > 0);
    for (const chunk of frameChunker(s.frames, s.chunk_size)) {
        const task = author.Task(`render-${chunk}`, "misc");
        task.addCommand(author.Command("exec", {
            exe: s.command,
            args: ["render", s.scene, "-o", `${s.folder}/${s.file_name}`, "--frames", chunk, "--skip-existing", "--progress", "text"].concat(options),
        }));
        job.addTask(task);
    }
}
