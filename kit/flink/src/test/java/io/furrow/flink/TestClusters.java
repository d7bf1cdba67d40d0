package io.furrow.flink;

import org.apache.flink.configuration.Configuration;
import org.apache.flink.runtime.testutils.MiniClusterResourceConfiguration;
import org.apache.flink.test.junit5.MiniClusterExtension;

/** Clusters of one task manager for the tests of a class. */
public final class TestClusters {
    private TestClusters() {}

    public static MiniClusterExtension of(int slots) {
        return of(slots, new Configuration());
    }

    public static MiniClusterExtension of(int slots, Configuration configuration) {
        return new MiniClusterExtension(new MiniClusterResourceConfiguration.Builder()
                .setNumberTaskManagers(1)
                .setNumberSlotsPerTaskManager(slots)
                .setConfiguration(configuration)
                .build());
    }
}
