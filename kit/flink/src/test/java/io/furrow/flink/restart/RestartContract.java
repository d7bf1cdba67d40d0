package io.furrow.flink.restart;

import java.nio.file.Path;
import java.util.concurrent.TimeUnit;
import java.util.function.LongFunction;

import org.apache.flink.runtime.minicluster.MiniCluster;
import org.apache.flink.test.junit5.InjectMiniCluster;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.api.io.TempDir;

/** What holds for every job that is restarted, see {@link Restarts}. */
@Timeout(value = 10, unit = TimeUnit.HOURS)
public abstract class RestartContract {
    @RegisterExtension
    static final MiniClusterExtension FLINK = Restarts.cluster();

    private final String stored;
    private final LongFunction<JobCase> caseOf;

    /**
     * @param stored folder of the job's savepoints
     * @param caseOf the case of a seed
     */
    protected RestartContract(String stored, LongFunction<JobCase> caseOf) {
        this.stored = stored;
        this.caseOf = caseOf;
    }

    @Test
    protected void writesWhatAnUndisturbedRunWritesWhereverItIsRestarted(
            @InjectMiniCluster MiniCluster flink, @TempDir Path folder) throws Exception {
        new Restarts(flink, folder).changeNothing(3, caseOf);
    }

    @Test
    protected void goesOnFromTheSavepointsOfReleases(@InjectMiniCluster MiniCluster flink, @TempDir Path folder)
            throws Exception {
        new Restarts(flink, folder).goOnFromReleases(stored, caseOf.apply(1));
    }
}
