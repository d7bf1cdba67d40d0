package io.furrow.control.secret;

import java.io.IOException;
import java.nio.file.Path;
import java.time.Clock;
import java.util.Properties;

/** Secret files with a clock of a test. */
public final class SecretFiles {
    private SecretFiles() {}

    public static SecretFile open(Path file, Properties client, Clock clock) throws IOException {
        return SecretFile.open(file, new SecretTopic(client, null), clock);
    }
}
