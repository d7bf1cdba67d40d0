package io.furrow.launcher.process;

import java.nio.file.Files;
import java.nio.file.Path;

import org.apache.logging.log4j.core.LoggerContext;

/** Configures the log file of the running suite. */
public final class LogFile {
    private LogFile() {}

    /** Logs to standard error, for a terminal or the journal of a service, unless the JVM was started with another log configuration. */
    public static void writeToErrorStream() {
        if (System.getProperty("furrow.log") == null) {
            writeTo(Path.of("/dev/stderr"));
        }
    }

    /** @param file {@code /dev/stderr}, also if that is a socket; another device; or a file, which is rotated at 10 MB */
    public static void writeTo(Path file) {
        System.setProperty("furrow.log", file.toString());
        System.setProperty("furrow.log.rotated", Boolean.toString(!Files.exists(file) || Files.isRegularFile(file)));
        LoggerContext.getContext(false).reconfigure();
    }
}
