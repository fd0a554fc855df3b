"""Sources, which yield frames with their time: recordings of any format, and cameras.

- ``folder``: recordings in regkit's own folder format.
- ``rosbag``: bags of ROS 1 and ROS 2, and MCAP files.
- ``realsense``: connected RealSense cameras, and their recordings.
- ``azure_kinect``: recordings of Azure Kinect cameras.
- ``formats``: not plug-ins; what several sources share.
"""
