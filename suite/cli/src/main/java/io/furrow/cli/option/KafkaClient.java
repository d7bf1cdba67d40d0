package io.furrow.cli.option;

import java.io.IOException;
import java.io.Reader;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Properties;

/** Settings of the Kafka clients of a command. */
public final class KafkaClient {
    private KafkaClient() {}

    /**
     * Returns the settings, including {@code bootstrap.servers}.
     *
     * @param propertiesFile for every client; null for none
     * @throws CommandException if the file cannot be read
     */
    public static Properties settings(String bootstrapServers, Path propertiesFile) {
        Properties properties = read(propertiesFile);
        properties.setProperty("bootstrap.servers", bootstrapServers);
        return properties;
    }

    /** Returns the content of a properties file; null for none. */
    public static Properties read(Path propertiesFile) {
        Properties properties = new Properties();
        if (propertiesFile != null) {
            try (Reader reader = Files.newBufferedReader(propertiesFile)) {
                properties.load(reader);
            } catch (IOException e) {
                throw new CommandException(
                        "--kafka-properties %s cannot be read; name a readable properties file"
                                .formatted(propertiesFile),
                        e);
            }
        }
        return properties;
    }
}
