package io.furrow.provisioner.account;

import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.atomic.AtomicLong;

import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.model.device.DeviceConnection;
import io.furrow.model.device.DeviceConnection.ForeignTopic;
import io.furrow.model.device.DeviceConnection.RefusedLogin;
import io.furrow.model.device.FarmSecret;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class InMemoryAccountsTest {
    private static final FarmSecret SECRET = new FarmSecret("0123456789abcdef".getBytes(UTF_8));
    private static final FarmSecret.Login DEVICE = SECRET.device("hoeing", "d");
    private static final FarmSecret.Login OTHER = SECRET.device("hoeing", "e");
    private static final String TOPIC = "/" + SECRET.apiKey("hoeing") + "/d/attrs";

    private final AtomicLong now = new AtomicLong(1000);
    private final InMemoryAccounts accounts = new InMemoryAccounts(now::get);

    @BeforeEach
    void letADeviceIn() {
        accounts.replace(List.of(MqttAccount.device(SECRET, "hoeing", "d")), Set.of());
    }

    @Test
    void recordsTheLastLogin() {
        assertThat(login(DEVICE.user(), DEVICE.password())).isTrue();
        now.set(2000);
        assertThat(login(DEVICE.user(), DEVICE.password())).isTrue();

        assertThat(accounts.reports()).containsExactly(Map.entry(DEVICE.user(), new LoginReport(2000L, null, null)));
    }

    @Test
    void countsRefusedLoginsSinceTheLastSuccess() {
        login(DEVICE.user(), "guessed");
        login(DEVICE.user(), DEVICE.password());
        now.set(2000);
        login(DEVICE.user(), "guessed");
        now.set(3000);
        login(DEVICE.user(), "guessed");
        login(OTHER.user(), OTHER.password());

        assertThat(accounts.reports().get(DEVICE.user()).refused())
                .isEqualTo(new RefusedLogin(2, 3000, DeviceConnection.WRONG_PASSWORD, DEVICE.user()));
        assertThat(accounts.reports().get(OTHER.user()).refused())
                .isEqualTo(new RefusedLogin(1, 3000, DeviceConnection.UNKNOWN_USER, OTHER.user()));
    }

    @Test
    void recordsForbiddenTopicsInBoundedLength() {
        assertThat(accounts.mayWrite(DEVICE.user(), TOPIC)).isTrue();
        assertThat(accounts.reports()).isEmpty();
        accounts.mayWrite(DEVICE.user(), "/other/d/attrs");
        accounts.mayWrite(DEVICE.user(), "/" + "t".repeat(60_000));

        ForeignTopic foreign = accounts.reports().get(DEVICE.user()).foreign();
        assertThat(foreign.count()).isEqualTo(2);
        assertThat(foreign.topic()).startsWith("/ttt").hasSizeLessThan(300);
    }

    /** Any client can name any number of users. */
    @Test
    void evictsUnknownUsersButNoOwner() {
        login(DEVICE.user(), DEVICE.password());
        for (int i = 0; i < 5000; i++) {
            login("stranger-" + i, "guessed");
        }
        login("s".repeat(60_000), "guessed");

        assertThat(accounts.reports()).hasSize(1001).containsKeys(DEVICE.user(), "stranger-4999");
    }

    @Test
    void dropsReportsOfARemovedAccount() {
        login(DEVICE.user(), DEVICE.password());

        accounts.replace(List.of(), Set.of());

        assertThat(accounts.reports()).isEmpty();
    }

    private boolean login(String user, String password) {
        return accounts.authenticates(user, password.getBytes(UTF_8));
    }
}
