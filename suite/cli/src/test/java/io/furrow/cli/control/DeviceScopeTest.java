package io.furrow.cli.control;

import org.junit.jupiter.api.Test;
import picocli.CommandLine;

import static org.assertj.core.api.Assertions.assertThat;

class DeviceScopeTest {
    @Test
    void namesTenantAndServicePathWhereTheyAreGiven() {
        assertThat(query()).isEmpty();
        assertThat(query("--fiware-service", "other")).isEqualTo("?service=other");
        assertThat(query("--fiware-service", "other", "--fiware-service-path", "/north"))
                .isEqualTo("?service=other&servicePath=%2Fnorth");
    }

    private static String query(String... options) {
        return CommandLine.populateCommand(new DeviceScope(), options).query();
    }
}
