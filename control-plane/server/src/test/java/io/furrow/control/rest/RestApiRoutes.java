package io.furrow.control.rest;

/** Tests routes of a running API; {@link RestApiIT} runs them. */
interface RestApiRoutes {
    RunningApi running();

    default ApiClient client() {
        return running().client();
    }
}
