package io.furrow.stores;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Path;
import java.time.Duration;
import java.util.Map;
import java.util.concurrent.TimeUnit;

import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.CoreOptions;
import org.apache.flink.core.fs.FileSystem;
import org.apache.flink.core.plugin.DefaultPluginManager;
import org.apache.flink.core.plugin.DirectoryBasedPluginFinder;
import org.apache.flink.runtime.testutils.MiniClusterResourceConfiguration;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.awaitility.Awaitility;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.FreePort;

import static org.assertj.core.api.Assertions.assertThat;

/** An S3 server in a process of its own, written to through Flink's S3 plugin, loaded as a cluster loads it. */
@Tag("full")
class ImagesOnS3IT {
    @RegisterExtension
    static final MiniClusterExtension FLINK = new MiniClusterExtension(new MiniClusterResourceConfiguration.Builder()
            .setNumberTaskManagers(1)
            .setNumberSlotsPerTaskManager(2)
            .build());

    @TempDir
    static Path folder;

    private static Process server;

    @BeforeAll
    static void start() throws Exception {
        int port = FreePort.orFree(0);
        server = new ProcessBuilder(
                        Path.of(System.getProperty("java.home"), "bin", "java").toString(),
                        "-Xmx256m",
                        "-jar",
                        Path.of("target/s3/server.jar").toAbsolutePath().toString(),
                        "--server.address=127.0.0.1",
                        "--server.port=" + FreePort.orFree(0),
                        "--http.port=" + port,
                        "--com.adobe.testing.s3mock.store.initialBuckets=farm",
                        "--com.adobe.testing.s3mock.store.root=" + folder.resolve("store"))
                .redirectErrorStream(true)
                .redirectOutput(folder.resolve("server.log").toFile())
                .start();
        URI endpoint = URI.create("http://127.0.0.1:" + port);
        Awaitility.await().until(() -> answers(endpoint));

        Configuration flink = new Configuration();
        flink.setString("s3.endpoint", endpoint.toString());
        flink.setString("s3.access-key", "farm");
        flink.setString("s3.secret-key", "secret");
        flink.setString("s3.path.style.access", "true");
        FileSystem.initialize(
                flink,
                new DefaultPluginManager(
                        new DirectoryBasedPluginFinder(Path.of("target/plugins")).findPlugins(),
                        CoreOptions.getPluginParentFirstLoaderPatterns(flink)));
    }

    @AfterAll
    static void stop() throws Exception {
        FileSystem.initialize(new Configuration(), null);
        server.destroy();
        if (!server.waitFor(10, TimeUnit.SECONDS)) {
            server.destroyForcibly();
        }
    }

    @Test
    void bringsAMissionBackFromItsArchive() throws Exception {
        ArchivedMission.comesBackFrom("s3://farm/archive");
    }

    @Test
    void keepsEachImageOnceUnderTheAddressThatItsEventCarries() throws Exception {
        String root = "s3://farm/images";

        Map<String, byte[]> stored = StoredByJob.run(root);

        assertThat(stored).hasSize(StoredByJob.IMAGES);
        assertThat(StoredByJob.files(root)).containsExactlyInAnyOrderEntriesOf(stored);

        Map<String, byte[]> again = StoredByJob.run(root); // as after a restart from an early checkpoint

        assertThat(again).containsExactlyInAnyOrderEntriesOf(stored);
        assertThat(StoredByJob.files(root)).containsExactlyInAnyOrderEntriesOf(stored);
    }

    private static boolean answers(URI endpoint) throws InterruptedException {
        try {
            HttpRequest request = HttpRequest.newBuilder(endpoint.resolve("/farm?list-type=2"))
                    .timeout(Duration.ofSeconds(2))
                    .build();
            return HttpClient.newHttpClient()
                            .send(request, HttpResponse.BodyHandlers.discarding())
                            .statusCode()
                    == 200;
        } catch (IOException e) {
            return false; // not there yet
        }
    }
}
