package io.furrow.launcher.process;

import java.nio.file.Files;
import java.nio.file.Path;

import org.apache.logging.log4j.core.LoggerContext;

/** Points the log to the file of the running suite; until then nothing is worth a line. */
public final class LogFile {
    private LogFile() {}

    /**
     * Points the log to the error stream, which a terminal shows and the journal of a service has, unless the JVM was started with another
     * log.
     */
    public static void writeToErrorStream() {
        if (System.getProperty("furrow.log") == null) {
            writeTo(Path.of("/dev/stderr"));
        }
    }

    /** @param file {@code /dev/stderr}, also where that is a socket; another device; or a file, which is renamed and begun anew at 10 MB */
    public static void writeTo(Path file) {
        System.setProperty("furrow.log", file.toString());
        System.setProperty("furrow.log.rotated", Boolean.toString(!Files.exists(file) || Files.isRegularFile(file)));
        LoggerContext.getContext(false).reconfigure();
    }
}
