package io.furrow.bench.whole;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;

/**
 * A built version of Furrow.
 *
 * @param name as tables call it
 * @param home the folder that holds {@code ./furrow}
 */
public record Checkout(String name, Path home) {
    /** The one that runs, by its commit; with {@code -dirty} where it has changes that are in none. */
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
     * Another commit of this repository, in a worktree below {@code target}, which stays for the next time; built where it is not yet.
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

    /** Shows what the build shows. */
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
