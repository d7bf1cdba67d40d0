package io.furrow.ingest;

import java.time.Duration;
import java.util.Optional;
import java.util.Set;
import java.util.stream.Collectors;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;

import io.furrow.flink.job.InputTopics;
import io.furrow.flink.job.JobOptions;
import io.furrow.flink.kafka.TopicOptions;
import io.furrow.ingest.image.ImageOptions;
import io.furrow.ingest.image.StorageMode;
import io.furrow.ingest.latest.LatestKey;
import io.furrow.ingest.mission.MissionOptions;
import io.furrow.ingest.route.AssignMission;

/** The options of the job {@code ingest}, with a group for each branch. */
@Command(
        name = "ingest",
        description = "Writes each event once to data.<domain>.realtime and data.<domain>.realtime.<mission>, and the "
                + "latest state of all entities to data.latest.")
public final class IngestOptions extends JobOptions {
    @Mixin
    private final TopicOptions topics = new TopicOptions();

    @Mixin
    private final ImageOptions images = new ImageOptions();

    @Mixin
    private final MissionOptions missions = new MissionOptions();

    @Option(
            names = "--parts",
            paramLabel = "PART,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "routes,latest,catalog,missions,images",
            description =
                    "Which of routes, latest, catalog, missions and images this instance does; other instances with "
                            + "otherwise equal options do the rest, so that an unavailable store stops only its own part. Without "
                            + "--name an instance of some parts is named ingest-PART-…. Default: ${DEFAULT-VALUE}; missions with "
                            + "--mongo and images with --images only.")
    private Set<IngestBranch> parts;

    @Option(
            names = "--default-domain",
            paramLabel = "NAME",
            description =
                    "Domain of entities for which neither their attributes nor service.devices name one. Default: none; "
                            + "they are only on the input topic and data.latest.")
    private String defaultDomain;

    @Option(
            names = "--default-mission",
            paramLabel = "NAME",
            description =
                    "Mission of entities for which neither their attributes nor service.devices name one. Default: none.")
    private String defaultMission;

    @Option(
            names = "--other-names",
            paramLabel = "N",
            defaultValue = "300",
            description = "Maximum number of topics for domains and missions that are not on service.domains and "
                    + "service.missions: each has partitions and a collection that stay. The same limit applies per "
                    + "subtask and run to names that get no topic, of an event without a domain or with --no-routes. A "
                    + "further name is a dead letter, unknown-mission; its event is processed without it. Default: "
                    + "${DEFAULT-VALUE}.")
    private int otherNames;

    @Option(
            names = "--repeat-window",
            paramLabel = "DURATION",
            defaultValue = "2min",
            description =
                    "How long, in event time, an event id is stored to drop duplicates. Longer: duplicates after longer "
                            + "failures are dropped, more state. Default: ${DEFAULT-VALUE}.")
    private Duration repeatWindow;

    @Option(
            names = "--device-history",
            paramLabel = "DURATION",
            defaultValue = "30d",
            description =
                    "How long former assignments of a device are stored. Longer: later events still find their mission, "
                            + "more state. Default: ${DEFAULT-VALUE}.")
    private Duration deviceHistory;

    @Option(
            names = "--devices",
            paramLabel = "TOPIC",
            defaultValue = "service.devices",
            description =
                    "Topic that assigns devices to domains and missions; it may be missing. Default: ${DEFAULT-VALUE}.")
    private String devices;

    @Option(names = "--no-routes", description = "Do not write to the topics of domains and missions.")
    private boolean noRoutes;

    @Option(names = "--no-latest", description = "Do not write to data.latest.")
    private boolean noLatest;

    @Option(
            names = "--deletion-memory",
            paramLabel = "DURATION",
            defaultValue = "24h",
            description =
                    "How long, in event time, the deletion of an entity is stored, so that an older event does not "
                            + "restore the entity on data.latest. At least as long as a disconnected gateway buffers events. "
                            + "Default: ${DEFAULT-VALUE}.")
    private Duration deletionMemory;

    @Option(names = "--no-catalog", description = "Do not write to data.catalog.")
    private boolean noCatalog;

    @Option(
            names = "--catalog-interval",
            paramLabel = "DURATION",
            defaultValue = "10s",
            description = "An entry of the catalog is written at most once per this event time. Default: "
                    + "${DEFAULT-VALUE}.")
    private Duration catalogInterval;

    @Option(
            names = "--catalog-retention",
            paramLabel = "DURATION",
            defaultValue = "90d",
            description =
                    "An entry of the catalog without an event for this event time is removed. Default: ${DEFAULT-VALUE}.")
    private Duration catalogRetention;

    @Option(
            names = "--latest-key",
            paramLabel = "KEY",
            defaultValue = "id",
            description =
                    "Key of the records on data.latest: id of the entity, or identity: tenant, service path and id. Use "
                            + "identity if two tenants have entities with the same id; otherwise one hides the other. Default: "
                            + "${DEFAULT-VALUE}.")
    private LatestKey latestKey;

    /**
     * Whether this instance does this part.
     *
     * @throws ParameterException if options that one of its parts needs are missing
     */
    boolean does(IngestBranch ingestBranch) {
        if (isDivided() && parts.contains(IngestBranch.MISSIONS) && !missions.isOn()) {
            throw refused("--parts missions has no server; add --mongo URI", null);
        }
        if (isDivided() && parts.contains(IngestBranch.IMAGES) && !images.areMoved()) {
            throw refused("--parts images has no folder; add --images URI, to the other instances too", null);
        }
        return parts.contains(ingestBranch);
    }

    private boolean isDivided() {
        return parts.size() < IngestBranch.values().length;
    }

    /** How this instance stores images, if they are moved. */
    StorageMode storing() {
        if (!isDivided()) {
            return StorageMode.ALL;
        }
        return does(IngestBranch.IMAGES) ? StorageMode.FOR_OTHERS : StorageMode.BY_OTHERS;
    }

    /** Rejects a replay, whose old values would reach {@code data.latest}, live topics and the mission's own collection. */
    @Override
    public InputTopics inputTopics() {
        InputTopics topics = super.inputTopics();
        if (topics.replay().isPresent()) {
            throw refused(
                    "--input " + String.join(",", input())
                            + " is a replay, which ingest does not take; analytics jobs do",
                    null);
        }
        return topics;
    }

    /** The default name is for the whole job: a part would resume in its consumer group and abort its transactions. */
    @Override
    public String jobName() {
        String name = super.jobName();
        if (isDivided() && name.equals(super.defaultName())) {
            throw refused("--name " + name + " is the name of all parts together; leave it out or name another", null);
        }
        return name;
    }

    @Override
    protected String defaultName() {
        return isDivided()
                ? super.defaultName() + "-"
                        + parts.stream().sorted().map(IngestBranch::code).collect(Collectors.joining("-"))
                : super.defaultName();
    }

    /** Settings for new topics. */
    public TopicOptions topics() {
        return topics;
    }

    /** Whether and how missions are stored in MongoDB. */
    public MissionOptions missions() {
        return missions;
    }

    public Optional<String> defaultDomain() {
        return Optional.ofNullable(defaultDomain);
    }

    public Optional<String> defaultMission() {
        return Optional.ofNullable(defaultMission);
    }

    public Duration repeatWindow() {
        return repeatWindow;
    }

    public Duration deletionMemory() {
        return deletionMemory;
    }

    public String devices() {
        return devices;
    }

    /** The rule that assigns domain and mission to events. */
    AssignMission.Rule assignment() {
        return new AssignMission.Rule(
                deviceHistory, defaultDomain().orElse(""), defaultMission().orElse(""));
    }

    /** Limit of topics of domains and missions that the control plane does not manage. */
    int otherNames() {
        if (otherNames < 0) {
            throw refused("--other-names " + otherNames + " is below 0", null);
        }
        return otherNames;
    }

    public boolean writesRoutes() {
        return !noRoutes;
    }

    public boolean writesLatest() {
        return does(IngestBranch.LATEST) && !noLatest;
    }

    public boolean writesCatalog() {
        return does(IngestBranch.CATALOG) && !noCatalog;
    }

    public Duration catalogInterval() {
        return catalogInterval;
    }

    public Duration catalogRetention() {
        return catalogRetention;
    }

    public LatestKey latestKey() {
        return latestKey;
    }

    ImageOptions images() {
        return images;
    }
}
