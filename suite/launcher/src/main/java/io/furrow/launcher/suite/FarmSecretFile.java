package io.furrow.launcher.suite;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Properties;

import io.furrow.cli.option.CommandException;
import io.furrow.kafka.secret.SecretFile;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.device.FarmSecretCodec;
import io.furrow.model.file.PrivateFile;

/** The file of the farm's secret. It is created for a new farm only: for an existing one, a new secret would lock out every device. */
public final class FarmSecretFile {
    private static final String NAME = "farm-secret";

    private FarmSecretFile() {}

    /**
     * The file of a suite: the configured one, else that in its directory, which is created if the directory is fresh.
     *
     * @param named null for the one in the directory
     * @throws CommandException if it does not exist; the message says what to do
     */
    static Path of(RunDirectory directory, Path named) {
        Path file = named == null ? directory.resolve(NAME) : named;
        try {
            if (named == null && directory.isFresh()) {
                make(file);
            } else if (named == null && !Files.exists(file)) {
                throw new CommandException(
                        ("%s has the data of a farm but not its secret, %s. Copy that file back, or name it with --farm-secret. If it is lost,"
                                        + " make another with ./furrow secret new %s, and give every device new credentials.")
                                .formatted(directory.path(), file, file));
            }
            FarmSecret.read(file);
            return file;
        } catch (IOException e) {
            throw unusable(e);
        }
    }

    /**
     * Refuses to create a temporary secret when parts outlive the suite: the next start would create another.
     *
     * @throws CommandException stating which file to name
     */
    static void requireLasting(RunDirectory directory, SuiteSettings settings) {
        SuiteSettings.Farm farm = settings.farm();
        boolean lasts = !directory.isTemporary() || farm.secret().file() != null;
        boolean outlived = settings.kafka() != null || farm.iotAgent() != null;
        if (!lasts && outlived) {
            throw new CommandException(
                    "Without --data the farm's secret would be deleted at the end, but Kafka, the IoT Agent or the MQTT broker that already run keep"
                            + " what is made with it. Name a directory with --data, or a secret with --farm-secret; ./furrow secret new FILE makes one.");
        }
    }

    /** Creates the file with a new secret. @throws FileAlreadyExistsException if it exists */
    public static FarmSecret make(Path file) throws IOException {
        FarmSecret secret = FarmSecret.generate();
        PrivateFile.create(file, FarmSecretCodec.write(secret));
        return secret;
    }

    /**
     * Opens a file that is followed while the process runs.
     *
     * @param client settings of Kafka clients
     * @param replaced fingerprint of the farm's former secret; null for none
     * @throws CommandException if it cannot be read or is not a secret; the message says what to do
     */
    public static SecretFile open(Path file, Properties client, String replaced) {
        try {
            return SecretFile.open(file, client, replaced);
        } catch (IOException e) {
            throw unusable(e);
        }
    }

    private static CommandException unusable(IOException cause) {
        return new CommandException(
                "The farm's secret cannot be used: %s."
                        .formatted(cause.getMessage().replaceFirst("\\.$", "")),
                cause);
    }
}
