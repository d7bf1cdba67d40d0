package io.furrow.ingest.image;

import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.configuration.CheckpointingOptions;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.PipelineOptions;
import org.apache.flink.configuration.RestartStrategyOptions;
import org.apache.flink.streaming.api.datastream.KeyedStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;

import io.furrow.files.Folders;
import io.furrow.flink.TestClusters;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.mission.image.ImageName;

import static org.assertj.core.api.Assertions.assertThat;

class ImagesAfterFailuresTest {
    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(2);

    private static final int IMAGES = 400;
    private static final int FAILURES = 6;

    @TempDir
    Path folder;

    @Command(name = "images")
    private static final class Options {
        @Mixin
        private final ImageOptions images = new ImageOptions();
    }

    @Test
    void leavesTheFilesAndEventsOfARunWithoutFailures() throws Exception {
        GatedStore.Gate gate = GatedStore.below(folder);
        gate.failures.set(FAILURES);

        List<ReportedEvent> passed = run();

        assertThat(gate.failures).hasValue(0);
        assertThat(passed).extracting(ReportedEvent::id).doesNotHaveDuplicates().hasSize(IMAGES);
        Map<String, Long> last = new HashMap<>();
        for (ReportedEvent event : passed) {
            assertThat(event.time()).isGreaterThan(last.getOrDefault(event.identity(), -1L));
            last.put(event.identity(), event.time());
        }
        assertThat(Folders.walk(folder).stream().filter(Files::isRegularFile))
                .hasSize(IMAGES)
                .allMatch(file -> file.getFileName().toString().matches("c\\d_\\d{17}\\.png"))
                .allSatisfy(file -> assertThat(file).hasBinaryContent(Pictures.png(seed(file))));
    }

    private static int seed(Path file) {
        String name = file.getFileName().toString();
        long time = ImageName.time(name.replaceAll(".*_(\\d{17}).*", "$1")).toEpochMilli();
        return (int) ((time - Pictures.TIME) % 16);
    }

    /** Each failure of the store fails the job: it has next to no timeout. */
    private List<ReportedEvent> run() throws Exception {
        Options options = new Options();
        JobCommandLine.of(options).parseArgs("--images", GatedStore.uri(folder), "--image-retry-timeout", "1ms");
        Configuration settings = new Configuration();
        settings.set(CheckpointingOptions.CHECKPOINTING_INTERVAL, Duration.ofMillis(20));
        settings.set(RestartStrategyOptions.RESTART_STRATEGY, "fixed-delay");
        settings.set(RestartStrategyOptions.RESTART_STRATEGY_FIXED_DELAY_ATTEMPTS, FAILURES);
        settings.set(RestartStrategyOptions.RESTART_STRATEGY_FIXED_DELAY_DELAY, Duration.ofMillis(1));
        settings.set(PipelineOptions.OBJECT_REUSE, true);
        StreamExecutionEnvironment env = StreamExecutionEnvironment.getExecutionEnvironment(settings);
        env.setParallelism(2);
        KeyedStream<ReportedEvent, String> cameras = env.fromSequence(0, IMAGES - 1)
                .setParallelism(1)
                .map(i -> Pictures.camera("c" + i % 5, Pictures.TIME + i, Pictures.png((int) (i % 16))))
                .setParallelism(1)
                .returns(TypeInformation.of(ReportedEvent.class))
                .keyBy(ReportedEvent::identity, Types.STRING);
        return new ArrayList<>(
                ImageStage.move(cameras, options.images, StorageMode.ALL).executeAndCollect(2 * IMAGES));
    }
}
