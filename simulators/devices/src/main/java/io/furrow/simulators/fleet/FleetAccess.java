package io.furrow.simulators.fleet;

import java.util.function.Function;
import java.util.function.Supplier;

import io.furrow.model.device.FarmSecret;
import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.mqtt.MqttAccess;
import io.furrow.simulators.scenario.SimulatedDevice;

/**
 * The servers of a fleet, and its credentials.
 *
 * @param fiware IoT Agent, context broker, tenant
 * @param logins at the MQTT broker
 */
public record FleetAccess(FleetSettings fiware, MqttAccess mqtt, Logins logins) {
    /**
     * The credentials of each connection.
     *
     * @param gateway by mission
     */
    public record Logins(
            Function<SimulatedDevice.Identity, MqttAccess.Login> device, Function<String, MqttAccess.Login> gateway) {
        /** One login for all. */
        public static Logins all(MqttAccess.Login login) {
            return new Logins(device -> login, mission -> login);
        }

        /**
         * The logins that the control plane provisions.
         *
         * @param secret the current one
         */
        public static Logins of(Supplier<FarmSecret> secret) {
            return new Logins(
                    device -> login(secret.get().device(device.mission(), device.id(), device.generation())),
                    mission -> login(secret.get().gateway(mission)));
        }

        private static MqttAccess.Login login(FarmSecret.Login login) {
            return new MqttAccess.Login(login.user(), login.password());
        }
    }
}
