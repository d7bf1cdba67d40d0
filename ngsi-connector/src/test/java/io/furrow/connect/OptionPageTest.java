package io.furrow.connect;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;

import org.junit.jupiter.api.Test;

import io.furrow.connect.sink.NgsiSinkConnector;
import io.furrow.connect.source.NgsiSourceConnector;

import static org.assertj.core.api.Assertions.assertThat;

class OptionPageTest {
    private static final Path PAGE = Path.of("docs", "configuration.md");
    private static final String RENEW =
            "./mvnw -pl ngsi-connector -am -Dtest=OptionPageTest -Dsurefire.failIfNoSpecifiedTests=false"
                    + " -Dfurrow.renew=true test";

    @Test
    void isWhatTheConnectorsSayOfTheirOptions() throws IOException {
        String page = "# Options of the NGSI connector\n\nMade from the code. After a change: `" + RENEW + "`\n\n"
                + OptionPage.of("Source", new NgsiSourceConnector().config()) + "\n"
                + OptionPage.of("Sink", new NgsiSinkConnector().config());
        if (Boolean.getBoolean("furrow.renew")) {
            Files.createDirectories(PAGE.getParent());
            Files.writeString(PAGE, page);
        }

        assertThat(PAGE).as("renew it with %s", RENEW).content().isEqualTo(page);
    }
}
