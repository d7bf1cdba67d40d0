package io.furrow.launcher.replay;

import java.io.OutputStream;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Optional;
import java.util.jar.JarOutputStream;
import java.util.jar.Manifest;

import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.RestOptions;
import org.apache.flink.configuration.SecurityOptions;
import org.apache.flink.configuration.WebOptions;
import org.apache.flink.runtime.minicluster.MiniCluster;
import org.apache.flink.runtime.minicluster.MiniClusterConfiguration;
import org.apache.kafka.clients.admin.NewTopic;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.cli.control.ReplayAnalyticsJob;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.files.Folders;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

@Tag("full")
class ClusterAnalyticsIT {
    private static final ReplayAnalyticsJob JOB = new ReplayAnalyticsJob("collision", "data.weeding.replay.0a1b2c3d");

    @TempDir
    Path folder;

    @AutoClose
    private MiniCluster cluster;

    /** The jar is empty: the cluster is in this JVM, and has the job's classes. */
    @Test
    void runsJobsOnAClusterByItsRestApi() throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(folder.resolve("kafka"), 0)) {
            cluster = cluster();
            kafka.createTopics(List.of(new NewTopic(JOB.topic(), Optional.of(1), Optional.empty())));
            cluster.start();
            URI url = cluster.getRestAddress().get();
            FlinkRest rest = new FlinkRest(url);
            List<String> options = List.of("--bootstrap-servers", kafka.bootstrapServers(), "--parallelism", "1");
            ClusterAnalytics analytics = new ClusterAnalytics(rest, emptyJar(), options, false);
            await().until(() -> analytics.free() == 2);

            analytics.start(JOB);
            analytics.start(new ReplayAnalyticsJob("presence", JOB.topic()));

            assertThat(analytics.running())
                    .containsExactlyInAnyOrder("collision-of-weeding.0a1b2c3d", "presence-of-weeding.0a1b2c3d");
            await().until(() -> analytics.free() == 0);
            assertThat(cluster.listJobs().get()).hasSize(2);
            assertThat(Folders.list(uploads()).stream()).hasSize(1);

            analytics.cancel(JOB.name());
            analytics.cancel("nothing");
            await().until(() -> analytics.running().size() == 1);
            assertThatThrownBy(() -> analytics.start(new ReplayAnalyticsJob("sowing", JOB.topic())))
                    .isInstanceOf(AnalyticsException.class)
                    .hasMessageContaining("/run");
        }
    }

    private MiniCluster cluster() {
        Configuration configuration = new Configuration();
        configuration.set(RestOptions.BIND_PORT, "0");
        configuration.set(RestOptions.BIND_ADDRESS, "127.0.0.1");
        configuration.set(RestOptions.ADDRESS, "127.0.0.1");
        configuration.set(SecurityOptions.DELEGATION_TOKENS_ENABLED, false);
        configuration.set(WebOptions.UPLOAD_DIR, folder.toString());
        return new MiniCluster(new MiniClusterConfiguration.Builder()
                .setConfiguration(configuration)
                .setNumTaskManagers(1)
                .setNumSlotsPerTaskManager(2)
                .setCommonBindAddress("127.0.0.1")
                .build());
    }

    private Path uploads() {
        return folder.resolve("flink-web-upload");
    }

    private Path emptyJar() throws Exception {
        Path jar = folder.resolve("empty.jar");
        Manifest manifest = new Manifest();
        manifest.getMainAttributes().putValue("Manifest-Version", "1.0");
        try (OutputStream out = Files.newOutputStream(jar);
                JarOutputStream entries = new JarOutputStream(out, manifest)) {
            entries.finish();
        }
        return jar;
    }
}
