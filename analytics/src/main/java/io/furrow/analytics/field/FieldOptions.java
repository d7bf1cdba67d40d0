package io.furrow.analytics.field;

import java.nio.file.Path;
import java.util.List;
import java.util.Optional;

import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

import io.furrow.model.field.FieldVersion;
import io.furrow.model.topic.Topics;

/** The options for the fields of a job. Holds no Flink type, like the options of every job. */
public final class FieldOptions {
    @Spec(Spec.Target.MIXEE)
    private CommandSpec spec;

    @Option(
            names = "--fields",
            paramLabel = "FILE",
            description =
                    "GeoJSON FeatureCollection of the fields: Polygons and MultiPolygons with an id, and a property"
                            + " Domain where they belong to one. Read where the job is started; --fields-topic is then not"
                            + " read. Default: the fields of --fields-topic.")
    private Path file;

    @Option(
            names = "--fields-topic",
            paramLabel = "TOPIC",
            defaultValue = Topics.FIELDS,
            description =
                    "Topic of the fields' versions, from which the job takes changes while it runs. It may be missing. "
                            + "Default: ${DEFAULT-VALUE}.")
    private String topic;

    /**
     * The fields of the file; empty if no file is configured.
     *
     * @throws ParameterException if the file cannot be used
     */
    Optional<List<FieldVersion>> file() {
        if (file == null) {
            return Optional.empty();
        }
        try {
            return Optional.of(GeoJsonFieldFile.read(file));
        } catch (InvalidFieldsException e) {
            throw new ParameterException(spec.commandLine(), e.getMessage(), e);
        }
    }

    public String topic() {
        return topic;
    }
}
