package io.furrow.dashboard.auth;

import java.net.InetAddress;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class AddressRangeTest {
    @ParameterizedTest
    @CsvSource(textBlock = """
            10.0.0.7,       10.0.0.7,    true
            10.0.0.7,       10.0.0.8,    false
            10.0.0.0/24,    10.0.0.255,  true
            10.0.0.0/24,    10.0.1.0,    false
            10.0.0.128/25,  10.0.0.127,  false
            10.0.0.128/25,  10.0.0.200,  true
            0.0.0.0/0,      192.0.2.1,   true
            0.0.0.0/0,      2001:db8::1, false
            2001:db8::/32,  2001:db8::1, true
            2001:db8::/32,  2001:db9::1, false
            ::1,            ::1,         true
            ::ffff:10.0.0.7, 10.0.0.7,   true
            """)
    void containsTheAddressesWithItsPrefix(String range, String address, boolean contained) throws Exception {
        assertThat(AddressRange.parse(range).contains(InetAddress.getByName(address)))
                .isEqualTo(contained);
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "", "localhost", "proxy.example.org", "10.0.0.0/33",
                "10.0.0.0/-1", "10.0.0.0/8/8", "1.2.3.4.5", "::1/129"
            })
    void rejectsNamesAndInvalidAddresses(String text) {
        assertThatThrownBy(() -> AddressRange.parse(text))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("neither an address");
    }
}
