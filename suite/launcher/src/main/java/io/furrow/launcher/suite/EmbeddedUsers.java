package io.furrow.launcher.suite;

import io.furrow.embedded.EmbeddedMqtt;
import io.furrow.provisioner.account.InMemoryAccounts;

/** The accounts of provisioned devices as users of the embedded MQTT broker. */
record EmbeddedUsers(InMemoryAccounts accounts) implements EmbeddedMqtt.Users {
    @Override
    public boolean authenticates(String user, byte[] password) {
        return accounts.authenticates(user, password);
    }

    @Override
    public boolean exists(String user) {
        return accounts.exists(user);
    }

    @Override
    public boolean mayWrite(String user, String topic) {
        return accounts.mayWrite(user, topic);
    }

    @Override
    public boolean mayRead(String user, String filter) {
        return accounts.mayRead(user, filter);
    }
}
