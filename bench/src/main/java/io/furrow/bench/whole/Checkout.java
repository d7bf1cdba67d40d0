package io.furrow.bench.whole;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;

/**
 * A built version of Furrow.
 *
 * @param name for tables
 * @param home the folder that contains {@code ./furrow}
 */
public record Checkout(String name, Path home) {
    /** The running one, by its commit; with {@code -dirty} if it has uncommitted changes. */
    public static Checkout here() throws IOException {
        Path home = Path.of(System.getProperty("furrow.home")).toAbsolutePath();
        Process git = new ProcessBuilder("git", "describe", "--always", "--dirty", "--exclude=*")
                .directory(home.toFile())
                .redirectError(ProcessBuilder.Redirect.INHERIT)
                .start();
        String name = new String(git.getInputStream().readAllBytes(), StandardCharsets.UTF_8).strip();
        if (name.isEmpty()) {
            throw new IOException(home + " is not a git repository; a measurement beside an older commit needs one");
        }
        return new Checkout(name, home);
    }

    /**
     * Another commit of this repository, in a worktree below {@code target} that is reused; built if necessary.
     *
     * @throws IOException if git has no such commit, or the build failed
     */
    public Checkout at(String commit) throws IOException, InterruptedException {
        Path other = home.resolve("target").resolve("whole").resolve(commit);
        if (!Files.exists(other.resolve("furrow"))) {
            Files.createDirectories(other.getParent());
            run(home, List.of("git", "worktree", "prune"));
            run(home, List.of("git", "worktree", "add", "--detach", other.toString(), commit));
        }
        Checkout checkout = new Checkout(commit, other);
        checkout.build();
        return checkout;
    }

    /** Shows the output of the build. */
    private void build() throws IOException, InterruptedException {
        run(home, List.of(home.resolve("furrow").toString(), "bench", "--help"));
    }

    private static void run(Path folder, List<String> command) throws IOException, InterruptedException {
        Process process = new ProcessBuilder(command)
                .directory(folder.toFile())
                .redirectError(ProcessBuilder.Redirect.INHERIT)
                .redirectOutput(
                        command.contains("bench") ? ProcessBuilder.Redirect.DISCARD : ProcessBuilder.Redirect.INHERIT)
                .start();
        if (process.waitFor() != 0) {
            throw new IOException(
                    "'%s' in %s ended with %d".formatted(String.join(" ", command), folder, process.exitValue()));
        }
    }
}
