package io.furrow.launcher.suite;

import java.io.IOException;
import java.nio.file.Path;

import org.apache.kafka.common.utils.Utils;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** The folder of a job with its checkpoints and savepoints. */
final class JobFolder {
    private static final Logger LOG = LoggerFactory.getLogger(JobFolder.class);

    private JobFolder() {}

    /** As Flink expects it: a URI whose path is not percent-encoded. */
    static String location(Path folder) {
        return new org.apache.flink.core.fs.Path(folder.toUri()).toString();
    }

    /** Deletes the folder and its content, if it exists, as far as possible. */
    static void delete(Path folder) {
        try {
            Utils.delete(folder.toFile());
        } catch (IOException e) {
            LOG.info("{} was not deleted, although it is not used any more", folder, e);
        }
    }
}
