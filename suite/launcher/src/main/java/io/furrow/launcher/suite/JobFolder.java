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

    /** As Flink takes it: a URI whose path stands as it is, without percent-encoding. */
    static String location(Path folder) {
        return new org.apache.flink.core.fs.Path(folder.toUri()).toString();
    }

    /** Deletes it with all that it holds, if it is there; what cannot be deleted stays. */
    static void delete(Path folder) {
        try {
            Utils.delete(folder.toFile());
        } catch (IOException e) {
            LOG.info("{} was not deleted, although it is not used any more", folder, e);
        }
    }
}
