package io.furrow.launcher;

import java.nio.file.Files;
import java.nio.file.Path;

import org.apache.logging.log4j.core.LoggerContext;

/** Points the log to the file of the running suite; until then nothing is worth a line. */
public final class LogFile {
    private LogFile() {}

    /** @param file a device, as {@code /dev/stderr}, or a file, which is renamed and begun anew at 10 MB */
    public static void writeTo(Path file) {
        System.setProperty("furrow.log", file.toString());
        System.setProperty("furrow.log.rotated", Boolean.toString(!Files.exists(file) || Files.isRegularFile(file)));
        LoggerContext.getContext(false).reconfigure();
    }
}
