package io.furrow.flink.job;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.util.function.Consumer;

import picocli.CommandLine;
import picocli.CommandLine.Command;
import picocli.CommandLine.Model.CommandSpec;

/** A job jar with one job that hands its options to the test. */
@Command(name = "jobs")
public final class TestJob {
    /** What the command line ended with. */
    public record Outcome(int exitCode, String out, String err) {}

    @Command(name = "copy", description = "Copies records.")
    static final class Copy extends JobOptions {}

    private TestJob() {}

    public static Outcome run(Consumer<JobOptions> job, String... arguments) {
        CommandLine line = JobCommandLine.starting(
                CommandSpec.forAnnotatedObject(new TestJob()).addSubcommand("copy", new CommandLine(new Copy())),
                job::accept);
        StringWriter out = new StringWriter();
        StringWriter err = new StringWriter();
        line.setOut(new PrintWriter(out, true)).setErr(new PrintWriter(err, true));
        return new Outcome(line.execute(arguments), out.toString(), err.toString());
    }
}
