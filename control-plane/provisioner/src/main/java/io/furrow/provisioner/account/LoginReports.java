package io.furrow.provisioner.account;

import java.util.Map;

/** What an MQTT broker noticed of its users. Safe from all threads. */
public interface LoginReports {
    /** By user. Of users without an account the newest are there, of others all of whom there is something to say. */
    Map<String, LoginReport> reports();
}
