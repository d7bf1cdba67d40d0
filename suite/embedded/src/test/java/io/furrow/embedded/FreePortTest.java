package io.furrow.embedded;

import java.io.IOException;
import java.net.BindException;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.ServerSocket;
import java.util.HashSet;
import java.util.Set;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class FreePortTest {
    @Test
    void isNeverOneOfOutgoingConnectionsNorGivenTwice() {
        Set<Integer> ports = new HashSet<>();
        for (int i = 0; i < 1_000; i++) {
            ports.add(FreePort.orFree(0));
        }

        assertThat(ports).hasSize(1_000).allSatisfy(port -> assertThat(port).isBetween(20_000, 26_999));
    }

    @Test
    void skipsAPortThatIsInUse() throws IOException {
        int next = FreePort.orFree(0) + 1;
        try (ServerSocket used = new ServerSocket()) {
            try {
                used.bind(new InetSocketAddress(InetAddress.getLoopbackAddress(), next));
            } catch (BindException e) {
                // in use by somebody else, which does as well
            }
            assertThat(FreePort.orFree(0)).isNotEqualTo(next);
        }
    }
}
