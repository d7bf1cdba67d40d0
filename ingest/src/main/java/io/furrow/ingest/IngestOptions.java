package io.furrow.ingest;

import java.time.Duration;
import java.util.Optional;
import java.util.concurrent.Callable;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.flink.JobOptions;
import io.furrow.ingest.image.ImageOptions;

/** The options of the job {@code ingest}. */
@Command(name = "ingest", description = "Routes events to data.<domain>.realtime and data.<domain>.realtime.<mission>.")
public final class IngestOptions extends JobOptions implements Callable<Integer> {
    @Option(
            names = "--default-domain",
            paramLabel = "NAME",
            description = "Domain of entities that name none. Default: none, they stay on the input topic only.")
    private String defaultDomain;

    @Option(
            names = "--default-mission",
            paramLabel = "NAME",
            description = "Mission of entities that name none. Default: none.")
    private String defaultMission;

    @Option(
            names = "--repeat-window",
            paramLabel = "DURATION",
            defaultValue = "2min",
            description =
                    "An event id passes once within this event time. Longer: repeats after longer failures are dropped, "
                            + "more state. Default: ${DEFAULT-VALUE}.")
    private Duration repeatWindow;

    @Mixin
    private ImageOptions images;

    public Optional<String> defaultDomain() {
        return Optional.ofNullable(defaultDomain);
    }

    public Optional<String> defaultMission() {
        return Optional.ofNullable(defaultMission);
    }

    public Duration repeatWindow() {
        return repeatWindow;
    }

    ImageOptions images() {
        return images;
    }

    @Override
    public Integer call() throws Exception {
        IngestJob.assemble(this).execute(jobName());
        return 0;
    }
}
