package io.furrow.ingest.image;

import java.net.URI;
import java.net.URISyntaxException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Optional;

import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

/** The options of the job {@code ingest} for images. */
public final class ImageOptions {
    @Spec(Spec.Target.MIXEE)
    private CommandSpec spec;

    @Option(
            names = "--images",
            paramLabel = "URI",
            description = "Write images below this folder on any Flink file system (file:, hdfs:, s3:) and let events "
                    + "carry a reference. Default: none, images stay in the events.")
    private String root;

    @Option(
            names = "--image-attribute",
            paramLabel = "NAME,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "Image",
            description = "Attributes that hold images in base64. Default: ${DEFAULT-VALUE}.")
    private List<String> attributes;

    @Option(
            names = "--image-max-bytes",
            paramLabel = "BYTES",
            defaultValue = "6291456",
            description = "A larger image becomes a dead letter. Default: ${DEFAULT-VALUE}.")
    private int maxBytes;

    @Option(
            names = "--image-threads",
            paramLabel = "N",
            defaultValue = "8",
            description =
                    "Concurrent writes of images per subtask, for different entities. Use more for a remote store. "
                            + "Default: ${DEFAULT-VALUE}.")
    private int threads;

    @Option(
            names = "--image-in-flight",
            paramLabel = "BYTES",
            defaultValue = "67108864",
            description =
                    "Maximum memory per subtask of events that wait for the store; then the subtask stops reading. "
                            + "Default: ${DEFAULT-VALUE}.")
    private long maxInFlight;

    @Option(
            names = "--image-retry-timeout",
            paramLabel = "DURATION",
            defaultValue = "1min",
            description = "How long the write of an image is retried before the job fails and restarts. Default: "
                    + "${DEFAULT-VALUE}.")
    private Duration timeout;

    /** Whether images are written to files. */
    public boolean areMoved() {
        return root != null;
    }

    /**
     * Empty if images stay in the events.
     *
     * @throws ParameterException naming the invalid option and the remedy
     */
    Optional<ImageSettings> settings(StorageMode storageMode) {
        if (root == null) {
            return Optional.empty();
        }
        check(maxBytes >= 1, "--image-max-bytes " + maxBytes + " lets no image pass; name at least 1");
        check(threads >= 1, "--image-threads " + threads + " writes nothing; name at least 1");
        check(maxInFlight >= 1, "--image-in-flight " + maxInFlight + " lets nothing pass; name at least 1");
        check(attributes.stream().noneMatch(String::isBlank), "--image-attribute has an empty name; leave it out");
        return Optional.of(new ImageSettings(
                folder(root), new LinkedHashSet<>(attributes), maxBytes, threads, maxInFlight, timeout, storageMode));
    }

    /** An absolute URI without a trailing slash; a value without a scheme is a local path, with any characters. */
    private String folder(String given) {
        try {
            URI uri = given.matches("(?s)[A-Za-z][A-Za-z0-9+.-]*:.*")
                    ? new URI(given)
                    : Path.of(given).toAbsolutePath().normalize().toUri();
            check(
                    uri.getPath() != null && uri.getQuery() == null && uri.getFragment() == null,
                    "--images " + given + " is not a folder; write for instance file:///data/images");
            return uri.toString().replaceAll("(?<=[^:/])/+$", "");
        } catch (URISyntaxException e) {
            throw refused(
                    "--images " + given + " is not a URI (" + e.getReason()
                            + "); write for instance s3://bucket/images",
                    e);
        }
    }

    private void check(boolean right, String message) {
        if (!right) {
            throw refused(message, null);
        }
    }

    ParameterException refused(String message, Throwable cause) {
        return new ParameterException(spec.commandLine(), message, cause);
    }
}
