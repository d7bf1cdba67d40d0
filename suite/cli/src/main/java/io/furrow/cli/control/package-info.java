/** The commands that speak with the control plane over its REST API. */
package io.furrow.cli.control;
