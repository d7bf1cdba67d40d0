package io.furrow.launcher;

import java.nio.file.Path;

import org.apache.logging.log4j.core.LoggerContext;

/** Points the log to the file of the running suite; until then nothing is worth a line. */
public final class LogFile {
    private LogFile() {}

    public static void writeTo(Path file) {
        System.setProperty("furrow.log", file.toString());
        LoggerContext.getContext(false).reconfigure();
    }
}
