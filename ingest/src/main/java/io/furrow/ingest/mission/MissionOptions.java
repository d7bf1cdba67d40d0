package io.furrow.ingest.mission;

import java.time.Duration;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

import com.mongodb.ConnectionString;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;
import picocli.CommandLine.TypeConversionException;

import io.furrow.flink.job.DurationConverter;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.Retention;

/** The options of the branch that stores missions in MongoDB. */
public final class MissionOptions {
    /** The maximum of an index of MongoDB. */
    private static final long MAX_SECONDS = Integer.MAX_VALUE;

    @Spec(Spec.Target.MIXEE)
    private CommandSpec spec;

    @Option(
            names = "--mongo",
            paramLabel = "URI",
            description =
                    "Store every event of a mission in this MongoDB, for instance mongodb://127.0.0.1:27017: database "
                            + "persistence, collection mission_<mission>. @FILE reads the URI, and so its password, from a file. "
                            + "Default: missions are not stored.")
    private String mongo;

    @Option(
            names = "--mongo-retry-timeout",
            paramLabel = "DURATION",
            defaultValue = "60s",
            description = "How long writes are retried while MongoDB is unavailable, before the job restarts. Default: "
                    + "${DEFAULT-VALUE}.")
    private Duration timeout;

    @Option(
            names = "--mongo-refusal-timeout",
            paramLabel = "DURATION",
            defaultValue = "5min",
            description =
                    "How long the write of a document is retried after an error of MongoDB that may be transient, before "
                            + "it becomes a dead letter. Shorter than Flink's checkpoint timeout, 10 min, because checkpoints wait "
                            + "for it. Default: ${DEFAULT-VALUE}.")
    private Duration refusalTimeout;

    @Option(
            names = "--mission-retention",
            paramLabel = "[MISSION=]DURATION",
            description =
                    "How long documents are stored after their event time; of one mission, or of all missions that are "
                            + "not named. May be repeated. Default: for ever.")
    private List<String> retention = List.of();

    /** Whether missions are stored. */
    public boolean isOn() {
        return mongo != null;
    }

    MongoAccess access() {
        try {
            new ConnectionString(mongo);
        } catch (IllegalArgumentException e) {
            throw refused("--mongo is not an address of MongoDB (%s); write for instance mongodb://127.0.0.1:27017"
                    .formatted(MongoAccess.fault(mongo, e)));
        }
        return new MongoAccess(mongo, new MongoAccess.Waits(timeout, refusalTimeout));
    }

    Retention retention() {
        Duration everywhere = null;
        Map<String, Duration> byMission = new LinkedHashMap<>();
        for (String given : retention) {
            int equals = given.lastIndexOf('=');
            Duration kept = duration(given.substring(equals + 1));
            if (equals < 0) {
                everywhere = kept;
            } else {
                byMission.put(given.substring(0, equals), kept);
            }
        }
        return Retention.of(everywhere, byMission);
    }

    private Duration duration(String text) {
        try {
            Duration kept = new DurationConverter().convert(text);
            if (kept.toSeconds() >= 1 && kept.toSeconds() <= MAX_SECONDS) {
                return kept;
            }
        } catch (TypeConversionException e) {
            throw refused("--mission-retention: " + e.getMessage());
        }
        throw refused("--mission-retention " + text + " is not between a second and 68 years; write for instance 30d");
    }

    private ParameterException refused(String message) {
        return new ParameterException(spec.commandLine(), message);
    }
}
