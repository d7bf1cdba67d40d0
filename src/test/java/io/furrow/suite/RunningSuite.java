package io.furrow.suite;

import java.io.OutputStreamWriter;
import java.io.PrintWriter;
import static java.nio.charset.StandardCharsets.UTF_8;
import java.nio.file.Path;

import io.furrow.launcher.process.Progress;
import io.furrow.launcher.suite.RunDirectory;
import io.furrow.launcher.suite.Suite;
import io.furrow.launcher.suite.SuiteSettings;

/** A suite on free ports for the time of a test, with what a test asks of it. */
public final class RunningSuite implements AutoCloseable {
    private final RunDirectory directory;
    private final Suite suite;

    private RunningSuite(RunDirectory directory, Suite suite) {
        this.directory = directory;
        this.suite = suite;
    }

    /** @param stored null for a temporary directory */
    public static RunningSuite start(Path stored) throws Exception {
        return start(stored, SuiteSettings.onFreePorts("2s"));
    }

    public static RunningSuite start(Path stored, SuiteSettings settings) throws Exception {
        RunDirectory directory = RunDirectory.open(stored);
        PrintWriter out = new PrintWriter(new OutputStreamWriter(System.out, UTF_8));
        return new RunningSuite(directory, Suite.start(settings, directory, new Progress(out)));
    }

    public Suite suite() {
        return suite;
    }

    public Ngsi ngsi() {
        return new Ngsi(suite);
    }

    TopicLog topic(String name) {
        return new TopicLog(suite, name);
    }

    @Override
    public void close() {
        suite.close();
        directory.close();
    }
}
